// Replay: a world's scene as an image behind the path, a dot where the slider says.
@LORE_REPLAY_BEGIN@
  let shown, parts, timer = null;

  function open(replay) {
    shown = replay;
    stage.replaceChildren();
    const { width, height, svg } = replay.world, unit = Math.max(width, height) / 800;
    stage.setAttribute("viewBox", `0 0 ${width} ${height}`);
    // As an image, so that a scene cannot run scripts.
    const scene = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" preserveAspectRatio="none">${svg}</svg>`;
    if (svg !== "") make("image", { x: 0, y: 0, width, height, preserveAspectRatio: "none", href: "data:image/svg+xml," + encodeURIComponent(scene) });
    const found = replay.values.filter(value => value !== null), least = Math.min(0, ...found), most = Math.max(0, ...found);
    const trail = make("g", { fill: "none", "stroke-width": 2.2 * unit, "stroke-linecap": "round" });
    const stretch = replay.window_length ?? 20;
    const trails = [];
    for (let from = 0; from < replay.x.length - 1; from += stretch) {
      const points = [];
      for (let k = from; k <= Math.min(from + stretch, replay.x.length - 1); ++k) points.push(`${replay.x[k]},${replay.y[k]}`);
      const value = replay.values[from / stretch] ?? null;
      trails.push(make("polyline", { points: points.join(" "), stroke: replay.values.length ? shade(value, least, most) : "#1a5ba4" }, trail));
    }
    make("circle", { cx: replay.x[0], cy: replay.y[0], r: 6 * unit, fill: "#2f9e6e" });
    parts = { trails, stretch, dot: make("circle", { id: "replay-robot", r: 8 * unit, fill: "#e0452f", stroke: "#222222", "stroke-width": unit }) };
    slider.max = replay.x.length - 1;
    slider.value = 0;
    show();
  }

  function show() {
    const k = Number(slider.value);
    parts.dot.setAttribute("cx", shown.x[k]);
    parts.dot.setAttribute("cy", shown.y[k]);
    const [, reward] = shown.rewards.findLast(change => change[0] <= k);
    parts.trails.forEach((piece, i) => piece.setAttribute("opacity", i * parts.stretch <= k ? 1 : .18));
    const value = shown.values[Math.floor(k / parts.stretch)];
    state.textContent = `step ${k} of ${shown.x.length - 1}, reward ${reward} ${shown.unit}` +
      (value === undefined ? "" : value === null ? ", window not in the knowledge base" : `, value ${value}`);
  }

@LORE_REPLAY_END@
