// The page of a run in a cell, made of what the notebook holds once and what is this run's own. The page says where the run is, and goes
// where the notebook asks it to; assets/web/saved.js has the other side.
async function render({ model, el }) {
  const simulator = await model.widget_manager.get_model(model.get("_simulator").slice("IPY_MODEL_".length));
  const frame = document.createElement("iframe");
  frame.title = "A run of the motion lab";
  frame.style.cssText = `width: 100%; height: ${model.get("height")}px; border: 0`;
  frame.srcdoc = model.get("_before") + simulator.get("text") + model.get("_after");
  let [begun, hears] = [false, false];
  const ask = () => {
    if (begun && !hears) frame.contentWindow?.postMessage({ motionLab: { tick: model.get("tick"), playing: model.get("playing") } }, "*");
  };
  const hear = ({ source, data }) => {
    if (source !== frame.contentWindow || !data?.motionLab) return;
    const { tick, playing, verdict } = data.motionLab;
    hears = true;
    // the first that it says is no answer to where it was to be; a page that fails is at no tick
    model.set(begun && tick !== null ? { tick, playing, verdict } : { verdict });
    hears = false;
    model.save_changes();
    if (!begun) {
      begun = true;
      ask();
    }
  };
  window.addEventListener("message", hear);
  model.on("change:tick", ask);
  model.on("change:playing", ask);
  el.append(frame);
  return () => {
    window.removeEventListener("message", hear);
    model.off("change:tick", ask);
    model.off("change:playing", ask);
  };
}
export default { render };
