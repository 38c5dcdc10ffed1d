// SPDX-License-Identifier: Apache-2.0
// pictures.mjs FOLDER GALLOP ELEPHANT: pictures of the viewer for the documents, from two streams (scripts/pictures).
// FOLDER/frame-*.png are those of the moving one. See tests/web/browser.mjs for the variables.
import { join } from 'node:path';
import { PATIENCE, launch, serve } from '../tests/web/browser.mjs';

const [folder, gallop, elephant] = process.argv.slice(2);
const { browser, close } = await launch();

async function open(stream, settings, { width, height, colorScheme = 'dark', hasTouch = false }, act) {
  const { url, stop } = await serve(stream);
  const context = await browser.newContext({ viewport: { width, height }, colorScheme, hasTouch, deviceScaleFactor: hasTouch ? 1.5 : 1 });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  await page.goto(`${url}#paused&${settings}`);
  await settle(page);
  await act(page);
  await context.close();
  stop();
}

// All is loaded, shown and at rest.
async function settle(page) {
  await page.waitForFunction(() => {
    const { state, stage } = limberViewer;
    const isStill = state.framesShown > 0 && !state.isShowing && !stage.flight && !stage.isDirty;
    globalThis.stillFor = isStill ? (globalThis.stillFor ?? 0) + 1 : 0;
    return stillFor > 8 && document.getElementById('s-loaded').textContent.includes('of') === false;
  });
}

// After some cuts, so that the times in it are of compiled code.
async function take(page, name) {
  for (let i = 0; i < 12; ++i) {
    await settle(page);
    await page.evaluate(() => limberViewer.seek(limberViewer.state.frame));
  }
  await settle(page);
  await page.screenshot({ path: join(folder, name), type: 'jpeg', quality: 82 });
}

const desk = { width: 1180, height: 680 };
const split = 'vertices=800&compare=split&colors=clusters&wireframe&frame=20';
await open(gallop, split, desk, (page) => take(page, 'viewer.jpg'));
await open(gallop, 'triangles=3000&compare=side&colors=errors&wireframe&frame=8', { ...desk, colorScheme: 'light' },
  (page) => take(page, 'viewer-light.jpg'));
await open(elephant, 'preset=frozen&frame=12', desk, (page) => take(page, 'viewer-frozen.jpg'));
await open(elephant, 'preset=fig12&frame=12', desk, (page) => take(page, 'viewer-along.jpg'));
await open(gallop, `${split}&wireframe`, { width: 390, height: 780, hasTouch: true }, async (page) => {
  await page.tap('#more');
  await page.waitForTimeout(400);
  await take(page, 'viewer-phone.jpg');
});

// The moving one: the stage alone, while the border between original and approximation goes there and back.
await open(gallop, 'vertices=700&compare=split&wireframe', { width: 600, height: 360 }, async (page) => {
  await page.addStyleTag({ content: '#panel, footer, header, #legend { display: none !important } body { grid-template: 1fr / 1fr !important }' });
  await page.evaluate(() => {
    limberViewer.stage.fit(false);
    limberViewer.stage.approach(limberViewer.stage.sphere.center.toArray(), 0.72);
  });
  const count = await page.evaluate(() => limberViewer.state.info.frameCount);
  for (let frame = 0; frame < count; ++frame) {
    const at = 0.47 - 0.2 * Math.cos((2 * Math.PI * frame) / count);
    await page.evaluate(([number, part]) => {
      limberViewer.seek(number);
      limberViewer.setSplit(part);
    }, [frame, at]);
    await page.waitForFunction((number) => limberViewer.state.shown.frame === number, frame);
    await settle(page);
    await page.screenshot({ path: join(folder, `frame-${String(frame).padStart(3, '0')}.png`) });
  }
});
await close();
