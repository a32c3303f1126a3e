// What stands beside the canvas: the colour key and the chapter's formulas, whose roles light in the page and in the canvas alike.

/** Fills `key` in `element`, and shows what of the formulas belongs to what is in front. */
export function beside({ element, key, widgets, send }) {
  for (const [type, on] of [["pointerover", true], ["focusin", true], ["pointerout", false], ["focusout", false]]) {
    element.addEventListener(type, ({ target }) => {
      const role = target.closest("[data-role]")?.dataset.role;
      if (role) send({ do: "light", role: on ? role : null });
    });
  }
  const entry = ({ role, text }) => {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.tabIndex = -1; // for pointers: keys and readers have the twins of the canvas's own key
    button.className = `role-${role}`;
    button.dataset.role = role;
    button.textContent = text;
    item.append(button);
    return item;
  };
  return {
    key: (widget) => key.replaceChildren(...(widgets[widget]?.key ?? []).map(entry)),
    formulas(names) {
      for (const item of element.querySelectorAll("[data-at]")) item.hidden = !item.dataset.at.split(" ").some((at) => names.includes(at));
    },
    light(role) {
      if (role) document.documentElement.dataset.lit = role;
      else delete document.documentElement.dataset.lit;
      for (const part of element.querySelectorAll("[data-role]")) part.toggleAttribute("data-lit", part.dataset.role === role);
    },
  };
}
