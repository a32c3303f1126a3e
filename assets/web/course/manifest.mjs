// imsmanifest.xml: what a learning platform reads of a SCORM 1.2 package.

const escape = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/**
 * The manifest of a course in one piece: `start` is the page that the platform opens, `counts` the parts that count,
 * `files` all names in the package but the manifest's own.
 *
 * It has no mastery score: a platform that knows one calls everybody failed who closes the page before reaching it.
 */
export const manifest = ({ title, description, start, counts, files }) => `<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="motion-lab-course" version="1.0"
  xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2"
  xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2"
  xmlns:imsmd="http://www.imsglobal.org/xsd/imsmd_rootv1p2p1"
  xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
  xsi:schemaLocation="http://www.imsproject.org/xsd/imscp_rootv1p1p2 imscp_rootv1p1p2.xsd
    http://www.imsglobal.org/xsd/imsmd_rootv1p2p1 imsmd_rootv1p2p1.xsd
    http://www.adlnet.org/xsd/adlcp_rootv1p2 adlcp_rootv1p2.xsd">
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>1.2</schemaversion>
    <imsmd:lom>
      <imsmd:general>
        <imsmd:title><imsmd:langstring xml:lang="en">${escape(title)}</imsmd:langstring></imsmd:title>
        <imsmd:language>en</imsmd:language>
        <imsmd:description><imsmd:langstring xml:lang="en">${escape(description)}</imsmd:langstring></imsmd:description>
      </imsmd:general>
    </imsmd:lom>
  </metadata>
  <organizations default="course">
    <organization identifier="course">
      <title>${escape(title)}</title>
      <item identifier="start" identifierref="pages" isvisible="true">
        <title>${escape(title)}</title>
        <!-- what counts for the score: any of book, lessons and assignments, joined by commas -->
        <adlcp:datafromlms>${counts.join(",")}</adlcp:datafromlms>
      </item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="pages" type="webcontent" adlcp:scormtype="sco" href="${escape(start)}">
${[...files].sort().map((name) => `      <file href="${escape(name)}"/>`).join("\n")}
    </resource>
  </resources>
</manifest>
`;
