// The viewer of the pictures. Without this script the pictures are shown side by side.
"use strict";

const WORDS = { expected: "1", actual: "2", difference: "3", all: "0", slider: "s", fit: "f", in: "+", out: "-", over: "o", next: "n", previous: "p" };
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

// Marks of pixels, as picture.rs stores them, from 128 on for wrong ones; and their colours.
const CONTESTED = 64, NOT_A_NUMBER = 128, BOTH = 192, WRONG = 255;
const COLOURS = { 0: [95, 207, 133, 90], [CONTESTED]: [255, 210, 63, 230], [NOT_A_NUMBER]: [255, 74, 64, 230], [BOTH]: [255, 148, 48, 230], [WRONG]: [255, 74, 64, 230] };
const isWrong = (mark) => mark >= NOT_A_NUMBER;

// The bytes of a picture, four a pixel.
async function bytesOf(image) {
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.drawImage(image, 0, 0);
  return pen.getImageData(0, 0, canvas.width, canvas.height).data;
}

function pictureOf(source) {
  const image = new Image();
  image.src = source;
  return image;
}

// The wrong pixels that touch one another, as lists of pixel numbers, the largest first.
function regionsOf(marks, width, height) {
  const regions = [], seen = new Uint8Array(width * height);
  for (let start = 0; start < seen.length; start++) {
    if (seen[start] || !isWrong(marks[4 * start])) continue;
    const region = [start];
    seen[start] = 1;
    for (let at = 0; at < region.length; at++) {
      const x = region[at] % width, y = (region[at] - x) / width;
      for (let ny = Math.max(y - 1, 0); ny <= Math.min(y + 1, height - 1); ny++) {
        for (let nx = Math.max(x - 1, 0); nx <= Math.min(x + 1, width - 1); nx++) {
          const next = ny * width + nx;
          if (!seen[next] && isWrong(marks[4 * next])) { seen[next] = 1; region.push(next); }
        }
      }
    }
    regions.push(region);
  }
  return regions.sort((a, b) => b.length - a.length);
}

// The pixel of a region whose channels are farthest off.
function worstOf(region, expected, actual) {
  const off = (n) => Math.max(...[0, 1, 2].map((c) => Math.abs(actual[4 * n + c] - expected[4 * n + c])));
  return region.reduce((worst, n) => (off(n) > off(worst) ? n : worst));
}

async function begin(root) {
  const find = (selector) => root.querySelector(selector);
  const image = find(".expected img"), width = image.naturalWidth || image.width, height = image.naturalHeight || image.height;
  const stored = (name) => (root.dataset[name] ? bytesOf(pictureOf(root.dataset[name])) : null);
  const [expected, actual, marks, weight, below, above] = await Promise.all(
    [bytesOf(image), bytesOf(find("figure.actual img")), ...["marks", "weight", "below", "above"].map(stored)]);
  const regions = regionsOf(marks, width, height);
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  find(".difference img").replaceWith(canvas);
  const layers = [...root.querySelectorAll(".layer")];
  const covers = layers.map((layer) => layer.appendChild(Object.assign(document.createElement("canvas"), { className: "over-it", width, height, hidden: true })));
  const cursors = layers.map((layer) => layer.appendChild(Object.assign(document.createElement("div"), { className: "mark", hidden: true })));
  let x = 0, y = 0, zoom = 1, panX = 0, panY = 0, region = -1, dragged = null;
  const set = (name, value) => root.style.setProperty(name, value);
  set("--width", width);
  set("--height", height);

  function difference(gain) {
    const pen = canvas.getContext("2d"), data = pen.createImageData(width, height);
    for (let n = 0; n < data.data.length; n++) {
      data.data[n] = n % 4 === 3 ? 255 : Math.abs(actual[n] - expected[n]) * gain;
    }
    pen.putImageData(data, 0, 0);
    find(".difference figcaption").textContent = `Difference ×${gain}`;
  }

  // Covers all three pictures with the marks of wrong pixels, or with the weights.
  function over(what) {
    covers.forEach((cover) => { cover.hidden = what === "none"; });
    root.querySelectorAll(".key").forEach((key) => { key.hidden = key.dataset.over !== what; });
    if (what === "none") return;
    const pens = covers.map((cover) => cover.getContext("2d")), data = pens[0].createImageData(width, height);
    for (let n = 0; n < width * height; n++) {
      data.data.set(what === "marks" ? COLOURS[marks[4 * n]] : [0, 0, 0, (255 - weight[4 * n]) * 0.85], 4 * n);
    }
    pens.forEach((pen) => pen.putImageData(data, 0, 0));
  }

  function at(nx, ny) {
    [x, y] = [Math.min(Math.max(nx, 0), width - 1), Math.min(Math.max(ny, 0), height - 1)];
    set("--at-x", x / width);
    set("--at-y", y / height);
    cursors.forEach((cursor) => { cursor.hidden = false; });
    read();
  }

  // Shows the levels of the pixel under the cursor, as 8-bit numbers.
  function read() {
    const n = 4 * (y * width + x), rgb = (bytes) => [0, 1, 2].map((c) => bytes[n + c]);
    const off = [0, 1, 2].map((c) => actual[n + c] - expected[n + c]);
    const show = (list) => list.map((v) => String(v).padStart(4)).join("");
    const found = marks[n] === NOT_A_NUMBER ? "not a number" : `${show(rgb(actual))}   off by ${show(off.map((v) => (v > 0 ? `+${v}` : v)))}`;
    const out = find("output");
    out.textContent = `column ${x}, row ${y}   expected ${show(rgb(expected))}   yours ${found}   `;
    if (below && above) out.append(`allowed ${[0, 1, 2].map((c) => `${expected[n + c] - below[n + c]}..${expected[n + c] + above[n + c]}`).join(" ")}   `);
    if (weight) out.append(`counts ${Math.round(weight[n] / 2.55)} %   `);
    if (marks[n] === CONTESTED || marks[n] === BOTH) out.append("correct tracers differ here   ");
    if (isWrong(marks[n])) out.append(Object.assign(document.createElement("b"), { textContent: "wrong" }));
    if (region >= 0 && regions[region].includes(y * width + x)) {
      out.append(`   region ${region + 1} of ${regions.length}, ${regions[region].length} pixels`);
    }
  }

  function look(newZoom, px, py) {
    // px, py: the point of the view that stays fixed, from 0 to 1.
    const old = zoom;
    zoom = Math.min(Math.max(newZoom, 1), 64);
    pan(px - ((px - panX) / old) * zoom, py - ((py - panY) / old) * zoom);
  }

  function pan(nx, ny) {
    [panX, panY] = [Math.min(0, Math.max(nx, 1 - zoom)), Math.min(0, Math.max(ny, 1 - zoom))];
    set("--zoom", zoom);
    set("--pan-x", panX);
    set("--pan-y", panY);
  }

  const centre = () => pan(0.5 - ((x + 0.5) / width) * zoom, 0.5 - ((y + 0.5) / height) * zoom);

  function jump(step) {
    if (regions.length === 0) { find("output").textContent = "no pixel is wrong"; return; }
    region = region < 0 ? (step > 0 ? 0 : regions.length - 1) : (region + step + regions.length) % regions.length;
    const n = worstOf(regions[region], expected, actual);
    zoom = Math.max(zoom, 4);
    at(n % width, Math.floor(n / width));
    centre();
  }

  function show(what) {
    root.dataset.show = what;
    root.querySelectorAll("[data-do]").forEach((button) => button.setAttribute("aria-pressed", button.dataset.do === what));
  }

  function act(what) {
    if (what === "next" || what === "previous") jump(what === "next" ? 1 : -1);
    else if (what === "in" || what === "out") look(what === "in" ? zoom * 2 : zoom / 2, 0.5, 0.5);
    else if (what === "over") { chosen.selectedIndex = (chosen.selectedIndex + 1) % chosen.length; over(chosen.value); }
    else if (what === "fit") { zoom = 1; pan(0, 0); }
    else show(what);
  }

  root.querySelectorAll(".view").forEach((view) => {
    const place = (event) => {
      const box = view.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    view.addEventListener("pointerdown", (event) => { view.setPointerCapture(event.pointerId); dragged = [...place(event), panX, panY]; });
    view.addEventListener("pointerup", () => { dragged = null; });
    view.addEventListener("pointermove", (event) => {
      active = root;
      const [px, py] = place(event);
      if (dragged) pan(dragged[2] + px - dragged[0], dragged[3] + py - dragged[1]);
      at(Math.floor(((px - panX) / zoom) * width), Math.floor(((py - panY) / zoom) * height));
    });
    view.addEventListener("dblclick", (event) => look(zoom * 2, ...place(event)));
    view.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey && zoom === 1) return; // the page scrolls
      event.preventDefault();
      look(zoom * (event.deltaY < 0 ? 1.25 : 0.8), ...place(event));
    }, { passive: false });
  });
  root.addEventListener("click", (event) => {
    active = root;
    const button = event.target.closest("[data-do]");
    if (button) act(button.dataset.do);
  });
  find(".split").addEventListener("input", (event) => set("--split", event.target.value));
  const chosen = find(".over");
  chosen.addEventListener("change", () => over(chosen.value));
  find(".gain").addEventListener("change", (event) => difference(Number(event.target.value)));
  root.act = act;
  root.step = ([dx, dy]) => { at(x + dx, y + dy); if (zoom > 1) centre(); };
  difference(Number(find(".gain").value));
  show("all");
  find(".tools").hidden = false;
  root.classList.add("live");
}

let active = null;

function wake(details) {
  if (!details.open) return;
  details.querySelectorAll(".viewer[data-marks]:not(.live):not([data-begun])").forEach((root) => {
    root.dataset.begun = "";
    begin(root);
  });
}

document.querySelectorAll("details.check").forEach((details) => {
  details.addEventListener("toggle", () => wake(details));
  wake(details);
});
document.addEventListener("focusin", (event) => { active = event.target.closest(".viewer") || active; });
document.addEventListener("keydown", (event) => {
  if (event.target.matches("input, select") || event.ctrlKey || event.metaKey || event.altKey) return;
  const root = active && active.act ? active : document.querySelector("details[open] .viewer.live");
  if (!root) return;
  const what = Object.keys(WORDS).find((word) => WORDS[word] === event.key) || (event.key === "=" ? "in" : null);
  if (what) root.act(what);
  else if (STEPS[event.key] && root.contains(document.activeElement)) root.step(STEPS[event.key]);
  else return;
  event.preventDefault();
});
