// Whether a run in the lab is where an assignment wants it: good enough to know when to hand it in. Marks come from
// `motion-lab grade`, which runs it again.

/** Which coordinates of a robot are angles. */
const ANGLES = { Rusty: [2], Hitch: [2, 3], Reach: [0, 1, 2] };
const TICKS_PER_SECOND = 20;

const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
const count = (number, one) => `${number} ${one}${number === 1 ? "" : "s"}`;

/** Judges states of the lab: what is missing, in words, and whether the run can be handed in. */
export function judge({ robot: name, at, within, hold, ticks, contacts }) {
  let since = null; // the tick from which on every state was within the goal
  let last = -1;
  return ({ tick, robots }) => {
    const robot = robots.find((robot) => robot.name === name && robot.coordinates.length >= at.length);
    if (!robot) return null;
    const angles = ANGLES[name];
    const away = at.map((goal, i) => Math.abs(angles.includes(i) ? wrap(goal - robot.coordinates[i]) : goal - robot.coordinates[i]));
    if (tick < last) since = null; // the reader went back
    last = tick;
    if (!away.every((length, i) => length <= within[i])) since = null;
    else since ??= tick;
    const held = since === null ? 0 : tick - since;
    if (robot.contacts > contacts) return { isDone: false, text: `It has touched something (${count(robot.contacts, "contact")}): drag the time line back to before that, or begin anew.` };
    if (tick > ticks) return { isDone: false, text: `${ticks / TICKS_PER_SECOND} s are over: begin anew.` };
    if (held >= hold) return { isDone: true, text: "It is there, and stays. Save the run now, and hand it in." };
    if (since !== null) return { isDone: false, text: "It is there: let it stand for a second." };
    const far = (i, length) => (angles.includes(i) ? `${((length * 180) / Math.PI).toFixed(0)}°` : `${length.toFixed(2)} m`);
    const missing = away.flatMap((length, i) => (length > within[i] ? [far(i, length)] : []));
    return { isDone: false, isUnderWay: true, text: `Off by ${missing.join(" and ")}; ${Math.ceil((ticks - tick) / TICKS_PER_SECOND)} s are left.` };
  };
}
