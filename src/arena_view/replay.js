// Replay: the arena as SVG, the robot where the slider says.
@LORE_REPLAY_BEGIN@
  let shown, parts, timer = null;

  function open(replay) {
    shown = replay;
    stage.replaceChildren();
    const arena = replay.arena;
    stage.setAttribute("viewBox", `0 0 ${arena.width} ${arena.height}`);
    const rectangle = ([x0, x1, y0, y1], fill) => make("rect", { x: x0, y: y0, width: x1 - x0, height: y1 - y0, fill });
    make("circle", { cx: arena.basket[0], cy: arena.basket[1], r: arena.basket[2], fill: "#f0e442", "fill-opacity": .5 });
    for (const wall of arena.walls) rectangle(wall, "#555555");
    const found = replay.values.filter(value => value !== null), least = Math.min(0, ...found), most = Math.max(0, ...found);
    const trail = make("g", { fill: "none", "stroke-width": 2.2, "stroke-linecap": "round" });
    const stretch = replay.window_length ?? 20;
    const trails = [];
    for (let from = 0; from < replay.x.length - 1; from += stretch) {
      const points = [];
      for (let k = from; k <= Math.min(from + stretch, replay.x.length - 1); ++k) points.push(`${replay.x[k]},${replay.y[k]}`);
      const value = replay.values[from / stretch] ?? null;
      trails.push(make("polyline", { points: points.join(" "), stroke: shade(value, least, most) }, trail));
    }
    parts = {
      trails, stretch,
      doors: arena.doors.map(door => rectangle(door, "#cc79a7")),
      balls: arena.balls.map(([x, y]) => make("circle", { cx: x, cy: y, r: 6, fill: "#d55e00" })),
      lamp: make("circle", { cx: arena.switch[0], cy: arena.switch[1], r: 7, stroke: "#222222" }),
      robot: make("g", { id: "replay-robot" }),
    };
    parts.body = make("circle", { r: arena.radius, stroke: "#222222", "stroke-width": 1.5 }, parts.robot);
    make("line", { x1: 0, y1: 0, x2: arena.radius, y2: 0, stroke: "#222222", "stroke-width": 2 }, parts.robot);
    slider.max = replay.x.length - 1;
    slider.value = 0;
    show();
  }

  function show() {
    const k = Number(slider.value), arena = shown.arena;
    parts.robot.setAttribute("transform", `translate(${shown.x[k]} ${shown.y[k]}) rotate(${shown.theta[k] * 180 / Math.PI})`);
    const events = shown.events.findLast(event => event[0] <= k);
    const [, carrying, door, lamp, mask, collected] = events;
    parts.body.setAttribute("fill", carrying ? "#d55e00" : "#ffffff");
    for (const part of parts.doors) part.setAttribute("visibility", door ? "hidden" : "visible");
    parts.balls.forEach((ball, i) => ball.setAttribute("visibility", mask >> i & 1 ? "visible" : "hidden"));
    parts.lamp.setAttribute("fill", lamp ? "#56b4e9" : "#ffffff");
    parts.trails.forEach((piece, i) => piece.setAttribute("opacity", i * parts.stretch <= k ? 1 : .18));
    const value = shown.values[Math.floor(k / parts.stretch)];
    state.textContent = `step ${k} of ${shown.x.length - 1}, ${collected} ${collected === 1 ? "ball" : "balls"} collected` +
      (carrying ? ", carrying" : "") + (value === undefined ? "" : value === null ? ", window not in the knowledge base" : `, value ${value}`);
  }

@LORE_REPLAY_END@
