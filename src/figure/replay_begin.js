const replays = JSON.parse(document.getElementById("replay-data")?.textContent ?? "[]");
if (replays.length > 0) {
  const stage = document.getElementById("replay-stage");
  const slider = document.getElementById("replay-slider");
  const chooser = document.getElementById("replay-chooser");
  const play = document.getElementById("replay-play");
  const state = document.getElementById("replay-state");
  // Pale for the lowest value to blue for the highest; gray where the knowledge base does not find the window, and after
  // the last whole window.
  const shade = (value, least, most) => {
    if (value === null) return "#bbbbbb";
    const share = most > least ? (value - least) / (most - least) : 0, mix = (a, b) => Math.round(a + (b - a) * share);
    return `rgb(${mix(222, 8)},${mix(235, 48)},${mix(247, 107)})`;
  };
  const make = (name, attributes, parent = stage) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent.append(element);
    return element;
  };
