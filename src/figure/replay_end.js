  function stop() {
    if (timer !== null) clearInterval(timer);
    timer = null;
    play.textContent = "Play";
  }

  slider.addEventListener("input", () => { stop(); show(); });
  chooser.addEventListener("change", () => { stop(); open(replays[Number(chooser.value)]); });
  play.addEventListener("click", () => {
    if (timer !== null) return stop();
    if (Number(slider.value) >= Number(slider.max)) slider.value = 0;
    play.textContent = "Pause";
    timer = setInterval(() => {
      slider.value = Number(slider.value) + 4;
      show();
      if (Number(slider.value) >= Number(slider.max)) stop();
    }, 33);
  });
  open(replays[0]);
}
