// Opens pages in Chromium and checks what a reader sees: on a desktop and on a phone, in light and
// dark colours.
//
//     CHROMIUM=/path/to/chromium node check.cjs PAGE.html...
//
// The packages of package.json must be in NODE_PATH. Before any page is checked, bad.html must fail
// every check.

"use strict";

const fs = require("fs");
const path = require("path");
const url = require("url");
const puppeteer = require("puppeteer-core");

const AXE = fs.readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const WIDTHS = [1280, 390];
const COLOURS = ["light", "dark"];

/** Returns the faults of the open page that can be seen in its layout, each with its check. */
function faultsOfLayout() {
  const faults = [];
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) {
    faults.push(["overflow", `the page is ${document.documentElement.scrollWidth} pixels wide`]);
  }
  const isVisible = (element) => {
    const box = element.getBoundingClientRect();
    return box.width > 0 && box.left >= 0 && box.right <= width;
  };
  // Cells of the class `more` are left out on a phone, since no advice rests on them.
  const cells = [...document.querySelectorAll("table.few :is(th, td):not(.more)")];
  const hidden = cells.filter((cell) => !isVisible(cell));
  if (hidden.length > 0) {
    faults.push(["columns", `${hidden.length} cells are out of view: ${hidden[0].textContent}`]);
  }
  if (cells.length === 0) faults.push(["columns", "the page has no table"]);
  // A plot of a question marks the scene and, with advice, the pick, as its table does.
  for (const section of document.querySelectorAll("section:has(figure svg)")) {
    const rings = [...section.querySelectorAll("svg .ring:not(.legend *)")].filter(isVisible);
    const labels = [...section.querySelectorAll("svg .marked")].filter(isVisible);
    const n = Math.max(section.querySelectorAll("table .badge").length, 1);
    if (rings.length < n || labels.length === 0) {
      faults.push(["marks", `#${section.id} has ${rings.length} of ${n} marks`]);
    }
    for (const label of labels) {
      label.scrollIntoView({ block: "center" });
      const box = label.getBoundingClientRect();
      const found = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
      if (found !== label) faults.push(["labels", `${label.textContent} is covered`]);
    }
  }
  for (const link of document.querySelectorAll("a[href^='#']")) {
    const id = link.getAttribute("href").slice(1);
    const image = document.getElementById(id)?.querySelector("img");
    if (!image || !image.complete || image.naturalWidth === 0) faults.push(["pictures", id]);
  }
  return faults;
}

/** Returns the violations of accessibility rules that axe-core finds in the open page. */
async function faultsOfAccess() {
  const { violations } = await window.axe.run();
  return violations.map(({ id, nodes }) => ["axe", `${id}: ${nodes[0].html.slice(0, 200)}`]);
}

/** Returns the faults of a page at one width and in one set of colours. */
async function faults(browser, file, width, colours) {
  const page = await browser.newPage();
  const found = [];
  page.on("console", (message) => {
    if (message.type() === "error") found.push(["policy", message.text()]);
  });
  page.on("pageerror", (error) => found.push(["policy", String(error)]));
  await page.setViewport({ width, height: 800 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: colours }]);
  await page.goto(url.pathToFileURL(path.resolve(file)).href, { waitUntil: "load" });
  found.push(...(await page.evaluate(faultsOfLayout)));
  await page.evaluate(AXE);
  found.push(...(await page.evaluate(faultsOfAccess)));
  await page.close();
  return found;
}

async function main(files) {
  if (files.length === 0) throw new Error("no page is given");
  // Chromium refuses to run as root with its sandbox, and containers often run as root.
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--no-sandbox", "--disable-dev-shm-usage"],
  });
  let status = 0;
  try {
    const bad = await faults(browser, path.join(__dirname, "bad.html"), 390, "light");
    for (const check of ["overflow", "columns", "marks", "labels", "pictures", "policy", "axe"]) {
      if (!bad.some(([name]) => name === check)) {
        console.error(`bad.html passes the check of ${check}, which therefore checks nothing`);
        status = 1;
      }
    }
    for (const file of files) {
      for (const width of WIDTHS) {
        for (const colours of COLOURS) {
          for (const [check, text] of await faults(browser, file, width, colours)) {
            console.error(`${file} at ${width} pixels, ${colours}: ${check}: ${text}`);
            status = 1;
          }
        }
      }
      console.log(`checked ${file}`);
    }
  } finally {
    await browser.close();
  }
  return status;
}

main(process.argv.slice(2)).then((status) => (process.exitCode = status));
