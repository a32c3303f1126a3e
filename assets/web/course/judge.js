// Whether a run in the lab is where an assignment wants it: good enough to know when to hand it in. Marks come from
// `motion-lab grade`, which runs it again.

const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
const count = (number, one) => `${number} ${one}${number === 1 ? "" : "s"}`;

/** Judges states of the lab by what an assignment asks for: what is missing, in words, and whether the run can be handed in. */
export function judge({ robot: name, names, at, within, is_angle: isAngle, hold, ticks, seconds, contacts }) {
  let since = null; // the tick from which on every state was within the goal
  let last = -1;
  return ({ tick, robots }) => {
    const robot = robots.find((robot) => robot.name === name && robot.coordinates.length >= at.length);
    if (!robot) return null;
    const away = at.map((goal, i) => Math.abs(isAngle[i] ? wrap(goal - robot.coordinates[i]) : goal - robot.coordinates[i]));
    if (tick < last) since = null; // the reader went back
    last = tick;
    if (!away.every((length, i) => length <= within[i])) since = null;
    else since ??= tick;
    const held = since === null ? 0 : tick - since;
    if (contacts !== null && robot.contacts > contacts) return { isDone: false, text: `It has touched something (${count(robot.contacts, "contact")}): drag the time line back to before that, or begin anew.` };
    if (tick > ticks) return { isDone: false, text: `${seconds} s are over: begin anew.` };
    if (held >= hold) return { isDone: true, text: "It is there, and stays. Save the run now, and hand it in." };
    if (since !== null) return { isDone: false, text: "It is there: let it stand for a second." };
    if (tick === 0) return { isDone: false, text: `Press Play to begin: you have ${seconds} s.` };
    const far = (i, length) => `${names[i]} ${isAngle[i] ? `${((length * 180) / Math.PI).toFixed(0)}°` : `${length.toFixed(2)} m`}`;
    const missing = away.flatMap((length, i) => (length > within[i] ? [far(i, length)] : []));
    return { isDone: false, isUnderWay: true, text: `Off by ${missing.join(", ")}; ${Math.ceil(((ticks - tick) * seconds) / ticks)} s are left.` };
  };
}
