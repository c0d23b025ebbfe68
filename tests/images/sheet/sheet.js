// Each comparison: a slider from the stored picture to that of today, and a button that shows one after the other.
for (const figure of document.querySelectorAll("figure.comparison")) {
  const stage = figure.querySelector(".stage");
  const slider = figure.querySelector("input");
  const [flicker, labels] = ["flicker", "labels"].map((name) => figure.querySelector(`button.${name}`));
  const show = (percent) => stage.style.setProperty("--cut", `${percent}%`);
  let timer = 0;
  let actual = false;
  const turn = () => {
    actual = !actual;
    show(actual ? 0 : 100);
    figure.querySelector(".side.left").classList.toggle("on", !actual);
    figure.querySelector(".side.right").classList.toggle("on", actual);
  };
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    flicker.setAttribute("aria-pressed", "false");
    stage.classList.remove("flickers");
    show(slider.value);
  };
  // Less than three changes a second: nobody is harmed by it.
  const start = () => {
    flicker.setAttribute("aria-pressed", "true");
    stage.classList.add("flickers");
    turn();
    timer = setInterval(turn, 500);
  };
  slider.addEventListener("input", () => (timer ? stop() : show(slider.value)));
  flicker.addEventListener("click", () => (timer ? stop() : start()));
  labels?.addEventListener("click", () => {
    const shown = labels.getAttribute("aria-pressed") !== "true";
    labels.setAttribute("aria-pressed", String(shown));
    stage.classList.toggle("unlabelled", !shown);
  });
  figure.addEventListener("keydown", (event) => {
    if (event.key === "f" && !event.ctrlKey && !event.metaKey && !event.altKey) flicker.click();
  });
}
