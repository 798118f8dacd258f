// Asks for facts.json every few seconds and shows it. Text enters the page as text alone (textContent, attributes),
// never as HTML: names and log lines may hold anything.
const every = 3000, everyHidden = 30000, patience = 15000;   // milliseconds
const byId = id => document.getElementById(id);
const svgNamespace = "http://www.w3.org/2000/svg";

// element("td", { class: "number" }, "3") and so on; children are elements or text.
function element(name, attributes = {}, ...children) {
  const made = ["svg", "line", "polyline", "text", "title"].includes(name)
    ? document.createElementNS(svgNamespace, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function say(id, text) {
  if (byId(id).textContent !== text) byId(id).textContent = text;   // else screen readers repeat it
}

function duration(seconds) {
  const whole = Math.max(0, Math.round(seconds)), two = number => String(number).padStart(2, "0");
  const hours = Math.floor(whole / 3600), minutes = Math.floor(whole / 60) % 60;
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

// As the page calls a state of 'lore-campaign status'.
const called = state => state === "missing" ? "not started" : state;

// Colors and dashes are those of the report: by the place among the treatments of one target task; of sources, which
// have one color, among these.
const colors = 7, patterns = ["none", "6 4", "2 2", "9 3 2 3", "9 2 2 2 2 2"];
function placed(treatments) {
  const places = new Map();
  return treatments.map(treatment => {
    const group = `${treatment.source} ${treatment.target}`, place = places.get(group) ?? 0;
    places.set(group, place + 1);
    return { ...treatment, place };
  });
}
const color = treatment => treatment.source ? "var(--source)" : `var(--c${treatment.place % colors})`;
const dashes = treatment =>
  patterns[treatment.source ? 1 + treatment.place % (patterns.length - 1) : Math.floor(treatment.place / colors) % patterns.length];
const stroke = treatment => `stroke: ${color(treatment)}; stroke-dasharray: ${dashes(treatment)}`;

// Rewards have the name of their unit where something is counted, and else a unit beside them.
const unitOf = facts => facts.reward_unit ?? "balls";
const best = facts => facts.best_balls ?? facts.balls ?? facts.best_reward ?? facts.reward;
const inDigits = value => Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(4)));
const mean = facts => facts.mean_balls !== undefined ? facts.mean_balls.toFixed(2) : inDigits(facts.mean_reward);
const withUnit = (value, facts) => `${typeof value === "number" ? inDigits(value) : value} ${unitOf(facts)}`;

function showSummary(facts) {
  document.title = `${Math.floor(100 * facts.share)} % - ${facts.title}`;
  say("title", facts.title);
  say("directory", facts.directory);
  say("notice", facts.notice);
  byId("notice").hidden = facts.notice === "";
  byId("share").value = facts.share;
  const counts = facts.counts, total = facts.steps.length;
  const parts = [`${counts.done} of ${total} steps done`, `${counts.running} running`];
  if (counts.interrupted > 0) parts.push(`${counts.interrupted} interrupted`);
  if (counts.failed > 0) parts.push(`${counts.failed} failed`);
  parts.push(`${Math.floor(100 * facts.share)} % of the generations`);
  if (facts.seconds_left !== null) parts.push(`about ${duration(facts.seconds_left)} left`);
  else if (total > 0 && counts.done === total) parts.push("all is done");
  else if (counts.running === 0) parts.push("nothing is at work");
  say("summary", parts.join(", ") + ".");
}

function showWork(facts) {
  const running = facts.steps.filter(step => step.state === "running");
  byId("work").hidden = running.length === 0;
  byId("work").querySelector("tbody").replaceChildren(...running.map(step => {
    const isRun = step.generations !== undefined, name = element("th", { scope: "row" }, step.name);
    if (!isRun) return element("tr", {}, name, element("td", { colspan: 4 }, "at work"));
    const bar = element("progress", { max: step.generations, value: step.generation, "aria-label": `Generations of ${step.name}` });
    const left = step.generation > 0 ? duration(step.seconds / step.generation * (step.generations - step.generation)) : "";
    return element("tr", {}, name, element("td", { class: "wide-only" }, bar),
      element("td", { class: "number" }, `${step.generation} of ${step.generations}`),
      element("td", { class: "number" }, withUnit(best(step), step)), element("td", { class: "number" }, left));
  }));
}

function showFailures(facts) {
  byId("failures").hidden = facts.failures.length === 0;
  const parts = facts.failures.flatMap(failure => {
    const what = element("p", {}, element("b", {}, failure.step), `: ${failure.reason}`);
    if (failure.tail.length === 0) return [what];
    return [what, element("p", { class: "note" }, `${failure.log} ends with:`), element("pre", {}, failure.tail.join("\n"))];
  });
  byId("failures").querySelector("div").replaceChildren(...parts);
}

function showTreatments(facts) {
  byId("treatments").hidden = facts.treatments.length === 0;
  byId("treatments").querySelector("tbody").replaceChildren(...placed(facts.treatments).map(treatment => {
    const swatch = element("svg", { class: "swatch", viewBox: "0 0 32 10", "aria-hidden": "true" }, element("line",
      { x1: 0, y1: 5, x2: 32, y2: 5, style: `${stroke(treatment)}; stroke-width: 5` }));
    const number = (value, more = "") => element("td", { class: `number ${more}` }, value);
    const began = treatment.started > 0;
    return element("tr", {}, element("th", { scope: "row" }, swatch, treatment.label),
      number(`${treatment.done} of ${treatment.runs}`), number(String(treatment.running)), number(String(treatment.failed), "wide-only"),
      number(began ? withUnit(mean(treatment), treatment) : ""), number(began ? withUnit(best(treatment), treatment) : ""));
  }));
}

// 1, 2 or 5 times a power of ten, so that there are some five marks up to `most`.
function tickStep(most) {
  const raw = most / 5, power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find(factor => factor * power >= raw);
}

function drawChart(treatments) {
  const width = Math.max(280, byId("chart").clientWidth), height = Math.min(420, Math.max(240, width * .55));
  const withLabels = width > 560;
  const left = 46, right = withLabels ? Math.max(170, width * .25) : 14, top = 12, bottom = 42;
  const mostX = Math.max(1, ...treatments.map(treatment => treatment.curve.at(-1)[0]));
  const unit = unitOf(treatments.at(-1)), means = treatments.flatMap(treatment => treatment.curve.map(point => point[1]));
  const counted = unit === "balls", span = Math.max(...means) - Math.min(...means) || 1;
  const leastY = counted ? 0 : Math.min(...means) - span * .04;
  const mostY = counted ? Math.max(1, ...means) : Math.max(...means) + span * .04;
  const x = generation => left + (width - left - right) * generation / mostX;
  const y = reward => height - bottom - (height - top - bottom) * (reward - leastY) / (mostY - leastY);
  const chart = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label":
    `Mean reward of the best-of-run by generation [${unit}]. ` + treatments.map(treatment =>
      `${treatment.label}: ${withUnit(treatment.curve.at(-1)[1], treatment)} at generation ${treatment.curve.at(-1)[0]}`).join("; ") });
  const stepX = Math.max(1, tickStep(mostX)), stepY = tickStep(mostY - leastY);
  for (let k = Math.ceil(leastY / stepY - 1e-9); k * stepY <= mostY + 1e-9 * stepY; ++k) {
    const at = y(k * stepY), reward = Number((k * stepY).toPrecision(6));
    chart.append(element("line", { class: "grid", x1: left, x2: width - right, y1: at, y2: at }));
    chart.append(element("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, String(reward)));
  }
  for (let k = 0; k * stepX <= mostX; ++k) {
    const at = x(k * stepX);
    chart.append(element("line", { class: "axis", x1: at, x2: at, y1: height - bottom, y2: height - bottom + 4 }));
    chart.append(element("text", { x: at, y: height - bottom + 18, "text-anchor": "middle" }, String(k * stepX)));
  }
  chart.append(element("polyline", { class: "axis", points: `${left},${top} ${left},${height - bottom} ${width - right},${height - bottom}` }));
  chart.append(element("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, "generation"));
  chart.append(element("text", { x: 13, y: (top + height - bottom) / 2, "text-anchor": "middle",
    transform: `rotate(-90 13 ${(top + height - bottom) / 2})` }, `best-of-run [${unit}]`));
  for (const treatment of treatments) {
    const whole = treatment.curve.filter(point => point[2] === treatment.started);
    const rest = treatment.curve.slice(Math.max(0, whole.length - 1));
    for (const [points, kind] of [[whole, "whole"], [rest, "early"]])
      if (points.length > 1) chart.append(element("polyline", { class: kind,
        style: stroke(treatment),
        points: points.map(point => `${x(point[0]).toFixed(1)},${y(point[1]).toFixed(1)}`).join(" ") }));
  }
  if (withLabels) labelCurves(chart, treatments, x, y, top);
  return chart;
}

// A chart a target task, under its label where there are several; sources share one if they share the unit.
function drawCharts(treatments) {
  const named = treatments.some(treatment => treatment.target !== undefined);
  const group = treatment => !named ? unitOf(treatment) : treatment.target ?? `source tasks [${unitOf(treatment)}]`;
  byId("chart").replaceChildren(...[...new Set(treatments.map(group))].flatMap(name => {
    const shown = treatments.filter(treatment => group(treatment) === name), chart = drawChart(shown);
    return named ? [element("h3", {}, shown[0].target_label ?? name), chart] : [chart];
  }));
  byId("chart").querySelectorAll("text.name").forEach(shorten);
}

// A label as far as it fits into the picture; its tool tip has all of it.
function shorten(label) {
  const room = label.ownerSVGElement.viewBox.baseVal.width - Number(label.getAttribute("x"));
  const text = label.lastChild, letters = [...text.data];
  while (label.getComputedTextLength() > room && letters.length > 0) {
    letters.pop();
    text.data = letters.join("") + "\u2026";
  }
}

// Each curve's label at its end, moved apart where ends are near.
function labelCurves(chart, treatments, x, y, top) {
  const labels = treatments.map(treatment => ({ treatment, x: x(treatment.curve.at(-1)[0]) + 6, y: y(treatment.curve.at(-1)[1]) + 4 }));
  labels.sort((a, b) => b.y - a.y);
  labels.forEach((label, i) => { if (i > 0) label.y = Math.max(top, Math.min(label.y, labels[i - 1].y - 14)); });
  for (const { treatment, x, y } of labels) {
    // "hard maze: " of a treatment on the hard maze stands above the chart already.
    const { label } = treatment, before = `${treatment.target_label}: `;
    chart.append(element("line", { class: "key", x1: x, x2: x + 18, y1: y - 4, y2: y - 4, style: stroke(treatment) }));
    chart.append(element("text", { class: "name", x: x + 22, y }, element("title", {}, label),
      label.startsWith(before) ? label.slice(before.length) : label));
  }
}

let drawn = [], sourceWasChosen = false;
function showCurves(facts) {
  const curves = placed(facts.treatments).filter(treatment => treatment.curve.length > 0);
  const targets = curves.filter(treatment => !treatment.source);
  if (!sourceWasChosen) byId("with-source").checked = targets.length === 0;
  // Rewards of different units share no axis.
  const beside = curve => targets.length === 0 || targets.at(-1).target !== undefined || unitOf(curve) === unitOf(targets.at(-1));
  const sources = curves.filter(treatment => treatment.source && beside(treatment));
  drawn = byId("with-source").checked ? [...sources, ...targets] : targets;
  byId("curves").hidden = curves.length === 0;
  byId("chart").hidden = drawn.length === 0;
  if (drawn.length > 0) drawCharts(drawn);
}

let replayed = "";
async function showRobots(facts) {
  const able = facts.champions.filter(champion => champion.problem === "");
  const wanted = JSON.stringify(facts.champions);
  byId("robots").hidden = facts.champions.length === 0;
  if (wanted === replayed) return;
  const robots = able.length === 0 ? [] : await ask("replay.json");
  if (robots.length !== able.length) return;   // one was replaced in between: next time
  replayed = wanted;
  const parts = [];
  if (able.length > 0) {
    const section = byId("replay-template").content.cloneNode(true);
    section.getElementById("replay-chooser").append(...able.map((champion, k) => element("option", { value: k },
      `${champion.label}: best of run ${champion.run.split("/").at(-1)}, ${withUnit(best(champion), champion)}`)));
    section.getElementById("replay-data").textContent = JSON.stringify(robots);
    parts.push(section);
  }
  for (const champion of facts.champions)
    if (champion.problem !== "") parts.push(element("p", { class: "note" }, `${champion.run}, ${withUnit(best(champion), champion)}: ${champion.problem}`));
  byId("robots-here").replaceChildren(...parts);
  if (able.length > 0) {
    const arenas = robots[0].arena !== undefined;
    say("signs", "Of the finished runs. " + (arenas ? "@LORE_ARENA_SIGNS@" : "Green: the start. Red: where it is."));
    if (arenas) startArenaReplay();
    else startWorldReplay();
    // The target task is what the campaign is about; its robot comes last.
    const chooser = byId("replay-chooser");
    chooser.selectedIndex = able.length - 1;
    chooser.dispatchEvent(new Event("change"));
    // The whole path at once; play begins at the start.
    byId("replay-slider").value = byId("replay-slider").max;
    byId("replay-slider").dispatchEvent(new Event("input"));
  }
}

const shownGroups = new Map();   // group: its <details>, and what it shows
function showSteps(facts) {
  const groups = new Map();
  for (const step of facts.steps) groups.set(step.group, [...groups.get(step.group) ?? [], step]);
  byId("steps").hidden = groups.size === 0;
  if ([...groups.keys()].join() !== [...shownGroups.keys()].join()) {
    shownGroups.clear();
    for (const group of groups.keys())
      shownGroups.set(group, { details: element("details", {}, element("summary"), element("div", { class: "scroll" })), text: "" });
    byId("steps").querySelector("div").replaceChildren(...[...shownGroups.values()].map(shown => shown.details));
  }
  for (const [group, steps] of groups) {
    const shown = shownGroups.get(group), text = JSON.stringify(steps);
    if (text === shown.text) continue;
    shown.text = text;
    const states = new Map();
    for (const step of steps) states.set(step.state, (states.get(step.state) ?? 0) + 1);
    const counts = [...states].map(([state, count]) => steps.length === 1 ? called(state) : `${count} ${called(state)}`).join(", ");
    shown.details.querySelector("summary").textContent = `${group}: ${counts}`;
    shown.details.querySelector("div").replaceChildren(stepsTable(steps));
  }
}

function stepsTable(steps) {
  const heading = (text, kind = "text") => element("th", { scope: "col", class: kind }, text);
  const head = element("thead", {}, element("tr", {}, heading("step"), heading("state"), heading("generation", "number"),
    heading("best", "number"), heading("what it says")));
  const rows = steps.map(step => {
    const isRun = step.generations !== undefined, began = isRun && (step.generation > 0 || step.state !== "missing");
    return element("tr", {}, element("th", { scope: "row" }, step.name), element("td", { class: `state-${step.state}` }, called(step.state)),
      element("td", { class: "number" }, began ? `${step.generation} of ${step.generations}` : ""),
      element("td", { class: "number" }, began ? withUnit(best(step), step) : ""), element("td", {}, step.reason === called(step.state) ? "" : step.reason));
  });
  return element("table", {}, head, element("tbody", {}, ...rows));
}

async function ask(path) {
  const answer = await fetch(path, { cache: "no-store", signal: AbortSignal.timeout(patience) });
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer.json();
}

let answered = null, timer = null;
async function look() {
  clearTimeout(timer);
  try {
    const facts = await ask("facts.json");
    answered = new Date();
    showSummary(facts);
    showWork(facts);
    showFailures(facts);
    showTreatments(facts);
    showCurves(facts);
    showSteps(facts);
    say("updated", `As of ${new Date(facts.time).toLocaleTimeString()}.`);
    await showRobots(facts);
  } catch (error) {
    say("updated", `No answer since ${answered === null ? "the beginning" : answered.toLocaleTimeString()} (${error.message}). ` +
      "Is 'lore-campaign watch' still running?");
  }
  clearTimeout(timer);
  timer = setTimeout(look, document.hidden ? everyHidden : every);
}

document.addEventListener("visibilitychange", () => { if (!document.hidden) look(); });
byId("with-source").addEventListener("change", () => { sourceWasChosen = true; look(); });
new ResizeObserver(() => { if (drawn.length > 0) drawCharts(drawn); }).observe(document.querySelector("main"));
look();
