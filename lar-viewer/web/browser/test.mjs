// A page of `lar export-html` in headless Chromium, opened from its file without a network: what is drawn, that dragging,
// picking, typing and saving do what they do in the window. Screenshots are left in the directory given.
//
//   node test.mjs PAGE.html DIRECTORY
import { chromium } from 'playwright-core';
import { PNG } from 'pngjs';
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [page_path, directory] = process.argv.slice(2).map((path) => resolve(path));
const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const SIZE = { width: 1280, height: 800 };
// Areas of the window: x, y, width, height.
const PICTURE = [260, 60, 720, 680];
const SELECTION = [0, 480, 230, 290];
// What an expression is answered, below its field.
const ANSWER = [998, 526, 270, 20];

mkdirSync(directory, { recursive: true });
const browser = await chromium.launch({
  executablePath,
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', '--allow-file-access-from-files'],
});
const context = await browser.newContext({ viewport: SIZE, offline: true, acceptDownloads: true });
await context.addInitScript(() => {
  globalThis.copied = [];
  Object.defineProperty(navigator, 'clipboard', {
    value: { writeText: async (text) => { globalThis.copied.push(text); } },
  });
});
const page = await context.newPage();
const said = [];
const requests = [];
page.on('console', (line) => { if (line.type() === 'error') said.push(line.text()); });
page.on('pageerror', (error) => said.push(String(error)));
page.on('request', (request) => requests.push(request.url()));

// The window as pixels, once two looks at it are the same.
async function settled(name) {
  let last = null;
  for (let i = 0; i < 60; i += 1) {
    await page.waitForTimeout(500);
    const now = await page.screenshot();
    if (last?.equals(now)) {
      writeFileSync(join(directory, `${name}.png`), now);
      return PNG.sync.read(now);
    }
    last = now;
  }
  throw new Error(`${name}: the window does not come to rest`);
}

// Share of the pixels of an area that differ visibly.
function changed(a, b, [x, y, width, height]) {
  let n = 0;
  for (let row = y; row < y + height; row += 1) {
    for (let column = x; column < x + width; column += 1) {
      const at = 4 * (row * a.width + column);
      if ([0, 1, 2].some((k) => Math.abs(a.data[at + k] - b.data[at + k]) > 8)) n += 1;
    }
  }
  return n / (width * height);
}

async function drag(from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let i = 1; i <= 8; i += 1) {
    await page.mouse.move(...[0, 1].map((k) => from[k] + ((to[k] - from[k]) * i) / 8));
    await page.waitForTimeout(50);
  }
  await page.mouse.up();
}

const steps = [];
async function step(what, run) {
  await run();
  steps.push(what);
  console.log(`ok: ${what}`);
}

let shown;
await step('the page opens and draws', async () => {
  const start = Date.now();
  await page.goto(pathToFileURL(page_path).href);
  const message = page.locator('#message');
  await page.waitForFunction(() => {
    const { hidden, textContent } = document.getElementById('message');
    return hidden || textContent !== 'Loading …';
  }, null, { timeout: 120000 });
  assert.ok(await message.isHidden(), await message.textContent());
  console.log(`    open after ${((Date.now() - start) / 1000).toFixed(1)} s`);
  shown = await settled('opened');
  const background = { ...shown, data: Buffer.alloc(shown.data.length) };
  const corner = shown.data.subarray(4 * (70 * SIZE.width + 270), 4 * (70 * SIZE.width + 270) + 4);
  for (let at = 0; at < background.data.length; at += 4) corner.copy(background.data, at);
  assert.ok(changed(shown, background, PICTURE) > 0.1, 'something is drawn');
});

await step('dragging the slider pulls the cells apart, and nothing else moves', async () => {
  await drag([1004, 83], [1030, 83]);
  const now = await settled('exploded');
  assert.ok(changed(shown, now, PICTURE) > 0.05, 'the picture has changed');
  assert.equal(changed(shown, now, SELECTION), 0);
  shown = now;
});

await step('a click shows what is known of a cell', async () => {
  await page.mouse.click(609, 400);
  const now = await settled('picked');
  assert.ok(changed(shown, now, SELECTION) > 0.02, 'the panel has changed');
  shown = now;
});

await step('a Boolean expression is answered as it is typed', async () => {
  await page.mouse.click(1100, 515);
  await page.keyboard.type('A - B', { delay: 50 });
  const now = await settled('boolean');
  assert.ok(changed(shown, now, ANSWER) > 0.02, 'cells and volume are told');
  assert.ok(changed(shown, now, PICTURE) > 0.02, 'its cells stand out');
  await page.keyboard.press('Control+a');
  await page.keyboard.press('Delete');
  // The keys belong to the field until something else is clicked.
  await page.mouse.click(620, 700);
  shown = await settled('no_expression');
});

await step('the camera is copied as arguments', async () => {
  await page.mouse.click(786, 12);
  await settled('copied');
  assert.match((await page.evaluate(() => globalThis.copied)).join(), /^--eye=.+ --target=.+/);
});

await step('dragging the picture turns it', async () => {
  await drag([620, 650], [720, 600]);
  const now = await settled('turned');
  assert.ok(changed(shown, now, PICTURE) > 0.05);
  shown = now;
});

await step('a screenshot is saved', async () => {
  const waiting = page.waitForEvent('download');
  await page.keyboard.press('s');
  const download = await waiting;
  assert.match(download.suggestedFilename(), /^lar-1\.png$/);
  await download.saveAs(join(directory, 'saved.png'));
  const saved = PNG.sync.read(readFileSync(join(directory, 'saved.png')));
  assert.ok(saved.width > 500 && saved.height > 500, `${saved.width} × ${saved.height}`);
  shown = await settled('after_saving');
});

await step('the canvas follows the window', async () => {
  await page.setViewportSize({ width: 1000, height: 700 });
  const small = await settled('smaller');
  assert.equal(small.width, 1000);
  await page.setViewportSize(SIZE);
  shown = await settled('larger');
});

assert.deepEqual(said, [], 'errors in the console');
assert.deepEqual(requests.filter((url) => !/^(file|blob|data):/.test(url)), [], 'nothing is loaded');
await browser.close();
console.log(`${steps.length} steps`);
