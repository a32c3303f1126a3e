// The book's Markdown: CommonMark and tables by markdown-it, formulas by Temml, and what a figure book needs beyond.
//
//   {0.0607 m: name}        a number, which must be the fact's; with `live PATH` behind the name it follows the figure's state
//   {?: name 0.0307 m}      a question: the reader's answer is compared with the fact's
//   [the arm](role:robot)   a term: it lights its role in the figure, and the figure lights it
//   [bend it](move:witness?q=0.785,1.9)  a link that moves a figure; without script it opens the lab there
//   $..$, $$ .. $$          a formula; \bind{0.0607}{name} is a number in one
//   ```facts, ```figure     blocks of lines; ```code PATH WORDS is what stands below the comment "// WORDS" of
//                         a file that the tests compile and run
import { createRequire } from "node:module";
import { decimalsOf, scaleOf, unbound, unitOf } from "./facts.mjs";

/** Does something; what fails is about `subject`. */
function about(subject, act) {
  try {
    return act();
  } catch (error) {
    throw Object.assign(error, { subject });
  }
}

/** How the page prints a value as `text` does: decimals, unit, and what the unit is in the lab's own. */
const digits = (text) => ` data-decimals="${decimalsOf(text)}" data-unit="${unitOf(text)}" data-scale="${scaleOf(unitOf(text))}"`;

export const escape = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/**
 * A function that makes HTML of the book's Markdown. `facts` are its numbers, `figure` makes a figure of the lines of its block, `region`
 * reads a part of a source file, `address` gives the address that opens the lab as a figure has it.
 */
export function renderer({ modules, facts, figure, region, address }) {
  const require = createRequire(`${modules}/`);
  const markdown = require("markdown-it")({ html: true, typographer: false });
  const temml = require("temml");

  const formula = (tex, displayMode) => {
    const rest = tex.replace(/\\bind\{([^{}]*)\}\{([\w-]+)\}/g, "");
    if (/\d\.\d/.test(rest)) throw new Error(`${rest.match(/\d*\.\d+/)[0]} in a formula is bound to nothing`);
    const bound = tex.replace(/\\bind\{([^{}]*)\}\{([\w-]+)\}/g, (_, text, name) => (facts.check(text, name), text.replace("−", "-")));
    // the pages' policy lets no element have a style of its own
    return temml.renderToString(bound, { displayMode, trust: true, throwOnError: true }).replace(/ style="[^"]*"/g, "");
  };

  /** A rule that makes HTML of what a pattern matches from the present place on. */
  const inline = (name, start, pattern, make) =>
    markdown.inline.ruler.before("escape", name, (state, silent) => {
      if (state.src[state.pos] !== start) return false;
      pattern.lastIndex = state.pos;
      const match = pattern.exec(state.src);
      if (!match) return false;
      if (!silent) state.push("html_inline", "", 0).content = about(match[0], () => make(...match.slice(1)));
      state.pos = pattern.lastIndex;
      return true;
    });
  inline("formula", "$", /\$([^$]+)\$/y, (tex) => formula(tex, false));
  inline("answer", "{", /\{\?: ([\w-]+) ([^{}]+)\}/y, (name, text) => {
    facts.check(text, name);
    return `<span class="answer"><input inputmode="decimal" size="8" aria-label="Your answer" data-answer="${facts.of(name).values[0]}"${digits(text)}> ${unitOf(text)}<output></output></span>`;
  });
  inline("number", "{", /\{([^{}?:]+): ([\w-]+)(?: live ([\w.]+))?\}/y, (text, name, live) => {
    facts.check(text, name);
    const shown = escape(text.replaceAll("-", "−"));
    return live ? `<span class="live" data-live="${live}"${digits(text)}>${shown}</span>` : `<span class="number">${shown}</span>`;
  });

  markdown.validateLink = () => true;
  markdown.renderer.rules.table_open = () => `<table tabindex="0">\n`; // on a phone it scrolls, by keys too
  markdown.renderer.rules.link_open = (tokens, i, options, _, self) => {
    const [, scheme, rest] = tokens[i].attrGet("href").match(/^(role|move):(.+)$/) ?? [];
    const close = tokens.slice(i).find((token) => token.type === "link_close");
    if (scheme === "role") {
      close.tag = "button";
      return `<button type="button" class="term role-${rest}" data-role="${rest}">`;
    }
    if (scheme === "move") {
      const [id, query = ""] = rest.split("?");
      tokens[i].attrs = [["href", address(id, query)], ["data-moves", id], ["data-query", query]];
    }
    return self.renderToken(tokens, i, options);
  };
  markdown.renderer.rules.fence = (tokens, i) => {
    const [kind, ...words] = tokens[i].info.trim().split(/\s+/);
    const text = tokens[i].content;
    if (kind === "facts") return "";
    if (kind === "figure") return figure(text, (inner) => markdown.renderInline(inner));
    if (kind === "math") return `<div class="formula" tabindex="0">${formula(text, true)}</div>\n`;
    if (kind === "code") return `<figure class="code"><figcaption><code>${escape(words[0])}</code></figcaption><pre tabindex="0"><code>${escape(region(words[0], words.slice(1).join(" ")))}</code></pre></figure>\n`;
    return `<pre tabindex="0"><code>${escape(text)}</code></pre>\n`;
  };

  /** Does something about `text`; what fails names the line and the sentence. */
  const within = (text, line, act) => {
    try {
      return act();
    } catch (error) {
      const sentence = text.split(SENTENCES).find((part) => error.subject && part.includes(error.subject)) ?? text;
      throw new Error(`line ${line}: ${error.message}\n  in: ${sentence.trim()}`);
    }
  };
  const refuseUnbound = (children) => {
    for (const text of plain(children).split(SENTENCES)) {
      const number = unbound(text);
      if (number) throw Object.assign(new Error(`${number} is bound to nothing`), { subject: number });
    }
  };
  // the facts of the whole book come first: a sentence may stand before what proves it
  markdown.core.ruler.at("inline", (state) => {
    for (const token of state.tokens.filter((token) => token.type === "fence" && token.info.trim() === "facts")) within(token.content, token.map[0] + 1, () => facts.read(token.content));
    for (const token of state.tokens.filter((token) => token.type === "inline")) {
      within(token.content, (token.map?.[0] ?? 0) + 1, () => {
        markdown.inline.parse(token.content, markdown, state.env, token.children);
        refuseUnbound(token.children);
      });
    }
  });
  const { fence } = markdown.renderer.rules;
  markdown.renderer.rules.fence = (tokens, i) => within(tokens[i].content, tokens[i].map[0] + 1, () => fence(tokens, i));
  return (source) => {
    const sections = [];
    markdown.renderer.rules.heading_open = (tokens, i) => {
      const title = tokens[i + 1].content;
      const id = title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "");
      if (tokens[i].tag === "h2") sections.push({ id, title });
      return `<${tokens[i].tag} id="${id}">`;
    };
    return { body: markdown.render(source), sections };
  };
}

const SENTENCES = /(?<=[.!?])\s/;

/** The prose of a paragraph: without code, and with a mark for what is bound. */
const plain = (children) => children.map(({ type, content }) => (type === "text" ? content : type === "softbreak" ? " " : "\u0001")).join("");
