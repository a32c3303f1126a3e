// Tasks of figures that no lesson of the lab has. A task takes the numbers that the book gives it, and gives a function
// that judges a state of the lab: how far the reader is, in words, and whether it is done; nothing for a state that is
// not about it.

/** Where a chain of links ends whose joints have these angles, each relative to the link before. */
function tipOf(lengths, angles) {
  let [x, y, heading] = [0, 0, 0];
  lengths.forEach((length, i) => {
    heading += angles[i];
    x += length * Math.cos(heading);
    y += length * Math.sin(heading);
  });
  return [x, y];
}

/** The same angle within half a turn of 0. */
const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
const metres = (length) => `${length.toFixed(2)} m`;
const degrees = (angle) => `${(Math.abs(angle) * 180 / Math.PI).toFixed(0)}°`;
const robotOf = (state, name, count) => state.robots.find((robot) => robot.name === name && robot.coordinates.length === count);

export const tasks = {
  /** The car's trailer is to stand at a pose: x, y, heading of its axle, which is `hitch` behind the car's. */
  trailer_at([hitch, x, y, heading]) {
    return (state) => {
      const car = robotOf(state, "Hitch", 4);
      if (!car) return null;
      const [carX, carY, , trailer] = car.coordinates;
      const [dx, dy] = [x - carX + hitch * Math.cos(trailer), y - carY + hitch * Math.sin(trailer)];
      const [ahead, left] = [dx * Math.cos(heading) + dy * Math.sin(heading), dy * Math.cos(heading) - dx * Math.sin(heading)];
      const turned = wrap(heading - trailer);
      const [along, across] = [ahead < 0 ? "back" : "ahead", left < 0 ? "to the right" : "to the left"];
      return {
        done: Math.hypot(dx, dy) <= 0.05 && Math.abs(turned) <= 0.05,
        text: `The trailer has to go ${metres(Math.abs(left))} ${across}, ${metres(Math.abs(ahead))} ${along}, and to turn by ${degrees(turned)}.`,
      };
    };
  },

  /**
   * An arm's tip is to be where it was at the start, to 2 cm, with the first joint turned by half a radian: links, then
   * angles at the start.
   */
  tip_rests(given) {
    const [lengths, start] = [given.slice(0, given.length / 2), given.slice(given.length / 2)];
    const tip = tipOf(lengths, start);
    return (state) => {
      const arm = robotOf(state, "Reach", lengths.length);
      if (!arm) return null;
      const now = tipOf(lengths, arm.coordinates);
      const strays = Math.hypot(now[0] - tip[0], now[1] - tip[1]);
      const turned = wrap(arm.coordinates[0] - start[0]);
      return {
        done: strays <= 0.02 && Math.abs(turned) >= 0.5,
        text: `The first joint has turned by ${degrees(turned)}, and the tip is ${metres(strays)} from where it was.`,
      };
    };
  },

  /** Bug1 by a sensor is to give up, which with an exact one it never does where there is a way. */
  sensor_misleads() {
    const ends = new Map(); // what became of each seed
    return ({ plan }) => {
      if (plan?.planner !== "bug1-sensor") return null;
      const gaveUp = plan.stage === "ended" && plan.why.includes("gave up");
      if (gaveUp || plan.stage === "solved") ends.set(plan.seed, gaveUp);
      if (ends.size === 0) return null;
      const lost = [...ends.values()].filter(Boolean).length;
      return { done: gaveUp, text: `Seeds walked: ${ends.size}. It gave up at ${lost} of them${gaveUp ? `; at ${plan.seed}, because ${plan.why.split("gave up: ")[1] ?? plan.why}` : ""}.` };
    };
  },
};
