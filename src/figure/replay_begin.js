const replays = JSON.parse(document.getElementById("replay-data")?.textContent ?? "[]");
if (replays.length > 0) {
  const stage = document.getElementById("replay-stage");
  const slider = document.getElementById("replay-slider");
  const chooser = document.getElementById("replay-chooser");
  const play = document.getElementById("replay-play");
  const state = document.getElementById("replay-state");
  const make = (name, attributes, parent = stage) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent.append(element);
    return element;
  };
