// A gamepad's stick, which drives the robot in hand.

/** Share of a stick's way within which it counts as at rest. */
const REST = 0.15;

/** Tells the lab the first gamepad's left stick, a frame at a time while there is one: its channels, ahead and to the left, up to 128. */
export function stick(send) {
  let told = "0,0";
  let isAsked = false;
  const channel = (axis) => 8 * Math.round(16 * (Math.abs(axis) < REST ? 0 : Math.max(-1, Math.min(1, axis)))) || 0;
  const ask = () => {
    isAsked = false;
    const pad = [...navigator.getGamepads()].find((p) => p?.connected);
    const channels = pad && !document.hidden ? [channel(-pad.axes[1]), channel(-pad.axes[0])] : [0, 0];
    if (String(channels) !== told) send({ do: "stick", channels });
    told = String(channels);
    if (pad) look();
  };
  const look = () => {
    if (!isAsked) requestAnimationFrame(ask);
    isAsked = true;
  };
  window.addEventListener("gamepadconnected", look);
  window.addEventListener("gamepaddisconnected", look);
}
