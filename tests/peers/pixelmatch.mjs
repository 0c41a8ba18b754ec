// Reads lines `EXPECTED<tab>ACTUAL`, answers each with the number of pixels that pixelmatch at its defaults finds different.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';

const require = createRequire(pathToFileURL(process.argv[2] + '/package.json'));
const { PNG } = require('pngjs');
const { default: pixelmatch } = await import(pathToFileURL(require.resolve('pixelmatch')));

for await (const line of createInterface({ input: process.stdin })) {
    const [expected, actual] = line.split('\t').map((path) => PNG.sync.read(readFileSync(path)));
    console.log(pixelmatch(expected.data, actual.data, undefined, expected.width, expected.height));
}
