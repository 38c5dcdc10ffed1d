// SPDX-License-Identifier: Apache-2.0
// The viewer in Chromium, as `limber view` serves it. See browser.mjs for the variables. LIMBER_PLAY_SECONDS=60 measures
// memory and long tasks for a minute instead of some seconds.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer, request } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { PATIENCE, chromium, launch, measurePlay, quantile, serve, watch } from './browser.mjs';

const program = process.env.LIMBER_PROGRAM;
const web = process.env.LIMBER_WEB;
const skip = existsSync(chromium) ? false : 'no Chromium here; scripts/setup test installs it';

const folder = mkdtempSync(join(tmpdir(), 'limber-viewer-'));
const file = (name) => join(folder, name);
const servers = [];
let launched;
let url;

async function view(...options) {
  const server = await serve(...options);
  servers.push(server);
  return server.url;
}

const status = (address, headers) =>
  new Promise((resolve) => request(address, { headers }, (response) => resolve(response.resume())).end());

// A page that must say nothing on its console while `act` runs.
async function withPage(address, act, { viewport = { width: 800, height: 500 }, isTouch = false, allow = /^$/ } = {}) {
  const context = await launched.browser.newContext({ viewport, hasTouch: isTouch, colorScheme: 'dark' });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE);
  await watch(page);
  const said = [];
  page.on('console', (message) => {
    const isNoise = /GPU stall|GL Driver Message/.test(message.text());
    if (['error', 'warning'].includes(message.type()) && !isNoise && !allow.test(message.text())) said.push(message.text());
  });
  page.on('pageerror', (error) => said.push(String(error.stack)));
  try {
    await page.goto(address);
    await act(page);
  } finally {
    await context.close();
  }
  assert.deepEqual(said, []);
}

const shows = (page, what) => page.waitForFunction(what, null, { polling: 50 });
const state = (page) => page.evaluate(() => ({ ...limberViewer.state.shown, there: limberViewer.state.bytesThere }));
const firstPicture = (page) => shows(page, () => limberViewer.state.framesShown > 0 && limberViewer.stage.sphere !== null);

describe('the viewer', { skip }, () => {
  before(async () => {
    const build = (clip, name, ...options) => execFileSync(program, ['build', clip, '-o', file(name), '-q', ...options]);
    build('sample:gallop?vertices=3000&frames=40', 'gallop.limber', '--keys', '8');
    build('sample:flag?vertices=300&frames=6', 'a flag & more.limber');
    launched = await launch();
    url = await view(file('gallop.limber'));
  });
  after(async () => {
    await launched?.close();
    for (const server of servers) server.stop();
    rmSync(folder, { recursive: true });
  });

  test('the server listens on the loopback interface, gives ranges, and knows its own name only', async () => {
    const whole = readFileSync(file('gallop.limber'));
    const stream = new URL(new URL(url).searchParams.get('stream'), url);
    assert.equal(stream.hostname, '127.0.0.1');
    const range = async (text) => {
      const response = await fetch(stream, { headers: { Range: `bytes=${text}` } });
      return [response.status, response.headers.get('Content-Range'), Buffer.from(await response.arrayBuffer())];
    };
    assert.deepEqual(await range('10-19'), [206, `bytes 10-19/${whole.length}`, whole.subarray(10, 20)]);
    assert.deepEqual(await range('-5'), [206, `bytes ${whole.length - 5}-${whole.length - 1}/${whole.length}`, whole.subarray(-5)]);
    const [last, said, bytes] = await range(`${whole.length - 3}-999999999999`);
    assert.deepEqual([last, said, bytes.length], [206, `bytes ${whole.length - 3}-${whole.length - 1}/${whole.length}`, 3]);
    assert.equal((await range(`${whole.length}-`))[0], 416);
    const all = await fetch(stream);
    assert.equal(all.status, 200);
    assert.equal(Buffer.compare(Buffer.from(await all.arrayBuffer()), whole), 0);
    assert.equal((await status(stream, { Host: 'elsewhere.example' })).statusCode, 421);
    assert.equal((await fetch(new URL('/etc/passwd', url))).status, 404);
  });

  test('a page opens, and plays', () =>
    withPage(url, async (page) => {
      await shows(page, () => limberViewer.state.framesShown > 5);
      assert.equal(await page.title(), 'gallop.limber – limber');
      assert.match(await page.textContent('#about'), /3,0\d\d\svertices · .* · 40\sframes/);
      await page.keyboard.press(' ');
      const { frame } = await state(page);
      await page.waitForTimeout(200);
      assert.ok((await state(page)).frame - frame <= 1, 'it stands still');
    }));

  test('changes are blended from frame to frame where that is asked for', () =>
    withPage(`${url}#paused&vertices=300&blend=4`, async (page) => {
      await firstPicture(page);
      const moving = () => page.evaluate(() => {
        const { last, info } = limberViewer.state;
        return last.meshes[0].nodes.reduce((sum, node) => sum + (node >= info.nodeCount ? 1 : 0), 0);
      });
      const goTo = async (frame) => {
        await page.evaluate((to) => limberViewer.seek(to), frame);
        await shows(page, `limberViewer.state.last?.frame === ${frame}`);
      };
      await goTo(9);
      assert.equal(await moving(), 0, 'a seek shows the cut as it is');
      for (const frame of [10, 11]) await goTo(frame);
      assert.ok((await moving()) > 0);
      assert.equal(await page.inputValue('#blend'), '4');
      await page.keyboard.press('2');
      await page.keyboard.press('m');
      await goTo(12);
      await page.keyboard.press('g');
      assert.equal(await page.inputValue('#blend'), '0');
      await shows(page, () => limberViewer.state.last.meshes[0].nodes.every((node) => node < limberViewer.state.info.nodeCount));
    }));

  test('the first picture needs the header and the first key, a seek its own key', () =>
    withPage(`${url}#paused&prefetch=0`, async (page) => {
      await firstPicture(page);
      await page.waitForTimeout(300);
      const size = readFileSync(file('gallop.limber')).length;
      const first = await page.evaluate(() => limberViewer.state.bytesAtFirstPicture);
      assert.ok(first < size / 3, `${first} of ${size}`);
      const before = (await state(page)).there;
      await page.evaluate(() => limberViewer.seek(34));
      await shows(page, () => limberViewer.state.shown.frame === 34);
      await page.waitForFunction((was) => limberViewer.state.bytesThere > was, before);
      const more = (await state(page)).there - before;
      assert.ok(more > 0 && more < size / 6, `${more} of ${size}`);
    }));

  test('scrubbing, keys of the keyboard, and the level of detail', () =>
    withPage(`${url}#paused`, async (page) => {
      await firstPicture(page);
      const box = await page.locator('#timeline').boundingBox();
      await page.mouse.click(box.x + box.width * 0.75, box.y + box.height / 2);
      await shows(page, () => limberViewer.state.shown.frame === 30);
      await page.keyboard.press('ArrowRight');
      await shows(page, () => limberViewer.state.shown.frame === 31);
      await page.keyboard.press('Shift+ArrowLeft');
      await shows(page, () => limberViewer.state.shown.frame === 24);
      await page.keyboard.press('End');
      await shows(page, () => limberViewer.state.shown.frame === 39);
      await page.keyboard.press('Home');
      await shows(page, () => limberViewer.state.shown.frame === 0);

      await page.fill('#number', '700');
      await page.keyboard.press('Enter');
      await shows(page, () => limberViewer.state.shown.triangles <= 700 && limberViewer.state.shown.triangles > 500);
      await page.click('#by >> text=Vertices');
      await page.fill('#number', '200');
      await page.keyboard.press('Enter');
      await shows(page, () => limberViewer.state.shown.vertices <= 200 && limberViewer.state.shown.vertices > 150);
      await page.click('#by >> text=Level');
      await page.fill('#number', '0');
      await page.keyboard.press('Enter');
      await shows(page, () => limberViewer.state.shown.vertices === limberViewer.state.info.vertexCount);
      await page.click('#by >> text=Pixels');
      await shows(page, () => limberViewer.state.shown.vertices < limberViewer.state.info.vertexCount);
      const near = (await state(page)).vertices;
      await page.mouse.move(400, 300);
      for (let i = 0; i < 8; ++i) await page.mouse.wheel(0, 400);
      await page.waitForFunction((was) => limberViewer.state.shown.vertices < was, near);
    }));

  test('the camera turns, and every look and comparison draws something else', () =>
    withPage(`${url}#paused&frame=5`, async (page) => {
      await firstPicture(page);
      const picture = async () => {
        await page.waitForTimeout(100);
        await shows(page, () => !limberViewer.state.isShowing && !limberViewer.stage.isDirty && !limberViewer.stage.flight);
        return page.locator('#stage').screenshot();
      };
      const pictures = [await picture()];
      await page.mouse.move(400, 300);
      await page.mouse.down();
      await page.mouse.move(480, 330, { steps: 4 });
      await page.mouse.up();
      await page.waitForTimeout(400);
      pictures.push(await picture());
      for (const key of ['2', '3', '4', 'w', 's', 'c', 'c', '1', 't']) {
        await page.keyboard.press(key);
        pictures.push(await picture());
      }
      for (let i = 1; i < pictures.length; ++i) assert.notEqual(Buffer.compare(pictures[i - 1], pictures[i]), 0, `picture ${i}`);
      await page.keyboard.press('m');
      await page.keyboard.press('ArrowRight');
      await shows(page, () => limberViewer.state.shown.frame === 6);
    }));

  test('an error in pixels follows the camera, and a frozen eye keeps its cut', () =>
    withPage(`${url}#paused&pixels=2`, async (page) => {
      await firstPicture(page);
      const settled = () => shows(page, () => !limberViewer.state.isShowing && !limberViewer.stage.flight);
      await settled();
      const whole = await state(page);
      assert.ok(whole.seenError > 0 && whole.seenError <= 2, `${whole.seenError}`);
      await page.evaluate(() => limberViewer.stage.approach(limberViewer.stage.sphere.center.toArray(), 0.4));
      await page.waitForFunction((was) => limberViewer.state.shown.vertices > was, whole.vertices);
      await settled();
      const near = await state(page);

      assert.equal(await page.isVisible('#inset'), false);
      await page.keyboard.press('z');
      await page.waitForSelector('#inset:visible');
      await settled();
      assert.equal(await page.evaluate(() => limberViewer.stage.frustum.visible), true);
      const shown = await page.evaluate(() => limberViewer.state.framesShown);
      await page.mouse.move(400, 300);
      for (let i = 0; i < 8; ++i) await page.mouse.wheel(0, 400);
      await page.keyboard.press('m'); // shows the same cut again
      await page.waitForFunction((was) => limberViewer.state.framesShown > was, shown);
      await settled();
      assert.equal((await state(page)).vertices, near.vertices);
      await page.keyboard.press('z');
      await page.waitForSelector('#inset', { state: 'hidden' });
      await settled();
      assert.ok((await state(page)).seenError <= 2);
    }));

  test('detail goes along an axis, into a ball, and to what is seen', () =>
    withPage(`${url}#paused&preset=fig12`, async (page) => {
      await firstPicture(page);
      // The mean place, between 0 and 1 from the fine end to the coarse one, of the vertices that are shown.
      const meanAlong = () =>
        page.evaluate(() => {
          const { stage, looking } = limberViewer;
          const { axis, from, to } = looking.along;
          const k = 'xyz'.indexOf(axis);
          const { positions, vertexCount } = stage.approximation.data;
          let sum = 0;
          for (let v = 0; v < vertexCount; ++v) sum += (positions[3 * v + k] - from) / (to - from);
          return sum / vertexCount;
        });
      await shows(page, () => limberViewer.looking.along && limberViewer.detail.by === 'vertices' && !limberViewer.state.isShowing);
      const one = await meanAlong();
      const text = await page.inputValue('#along');
      await page.selectOption('#along', text.startsWith('-') ? text.slice(1) : `-${text}`);
      await shows(page, () => !limberViewer.state.isShowing);
      const other = await meanAlong(); // from its own fine end
      assert.ok(one + other < 0.95, `${one} and ${other}: vertices are nearer to the end that is finest`);
      await page.selectOption('#along', '');

      await page.click('.chip:has(#focus)');
      await shows(page, () => limberViewer.looking.focus && !limberViewer.state.isShowing);
      const { x, y, width, height } = await page.locator('#canvas').boundingBox();
      const before = await page.evaluate(() => limberViewer.looking.focus.center);
      await page.mouse.dblclick(x + width / 2, y + height / 2);
      await page.waitForFunction((was) => String(limberViewer.looking.focus.center) !== String(was), before);
      await page.keyboard.press('v');
      await shows(page, () => !limberViewer.state.isShowing && limberViewer.state.shown.seenError > 0);
      assert.equal(await page.isVisible('#s-seen'), true);
      for (const preset of ['pixel', 'part', 'frozen', 'plain']) {
        await page.selectOption('#preset', preset);
        await shows(page, () => !limberViewer.state.isShowing);
      }
      assert.equal(await page.evaluate(() => limberViewer.looking.view('triangles')), null);
    }));

  test('a file is dropped, and something else is refused in words', () =>
    withPage(url, async (page) => {
      await firstPicture(page);
      const drop = async (name, bytes) => {
        const data = await page.evaluateHandle(
          ([name, list]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([Uint8Array.from(list)], name));
            return transfer;
          },
          [name, [...bytes]],
        );
        await page.dispatchEvent('#stage', 'dragenter', { dataTransfer: data });
        await page.dispatchEvent('#stage', 'drop', { dataTransfer: data });
      };
      await drop('flag.limber', readFileSync(file('a flag & more.limber')));
      await shows(page, () => limberViewer.state.info?.frameCount === 6 && limberViewer.state.shown);
      assert.equal(await page.textContent('#name'), 'flag.limber');
      await drop('song.mp3', Buffer.from('ID3 and so on, which is no stream at all'));
      await page.waitForSelector('#card:visible');
      assert.equal(await page.textContent('#card h2'), 'This is not a .limber stream');
      assert.equal(await page.isVisible('#close'), false);
      assert.equal(await page.textContent('#s-triangles'), '–', 'nothing is left of the stream before');
      assert.equal(await page.evaluate(() => limberViewer.stage.approximation.geometry.drawRange.count), 0);
      const damaged = Buffer.from(readFileSync(file('a flag & more.limber')));
      damaged[damaged.length >> 1] ^= 16;
      await drop('damaged.limber', damaged);
      await shows(page, () => !document.getElementById('card').hidden && /cannot be read/.test(document.getElementById('card').textContent));
      assert.match(await page.textContent('#card p'), /byte \d+: .*checksum/);
      const older = Buffer.from(damaged);
      older.writeUInt32LE(1, 8);
      await drop('older.limber', older);
      await shows(page, () => /another version/.test(document.querySelector('#card h2').textContent));
      assert.match(await page.textContent('#card p'), /version 1 of the format; this limber reads version 2/);
      const late = Buffer.from(readFileSync(file('gallop.limber')));
      late[late.length - (late.length >> 3)] ^= 16;
      await drop('late.limber', late);
      await shows(page, () => limberViewer.state.info?.frameCount === 40 && limberViewer.state.shown);
      await page.evaluate(() => limberViewer.setPlaying(false));
      for (let frame = 39; frame > 30 && !(await page.isVisible('#card')); --frame) {
        await page.evaluate((to) => limberViewer.seek(to), frame);
        await shows(page, `limberViewer.state.last?.frame === ${frame} || !document.getElementById('card').hidden`);
      }
      assert.equal(await page.textContent('#card h2'), 'A part of this stream cannot be read');
      await page.click('#close');
      await page.evaluate(() => limberViewer.seek(3));
      await shows(page, () => limberViewer.state.last?.frame === 3 && document.getElementById('card').hidden);
      await drop('short.limber', readFileSync(file('gallop.limber')).subarray(0, 300));
      await shows(page, () => /ends before its first frame/.test(document.getElementById('card').textContent));
      await drop('flag.limber', readFileSync(file('a flag & more.limber')));
      await shows(page, () => document.getElementById('card').hidden && limberViewer.state.shown);
    }));

  test('a lost connection is said, and mended', () =>
    withPage(
      'about:blank',
      async (page) => {
        let isDown = false;
        await page.route('**/stream/**', (route) => (isDown ? route.abort() : route.continue()));
        await page.goto(`${url}#paused&prefetch=0`);
        await firstPicture(page);
        isDown = true;
        await page.evaluate(() => limberViewer.seek(30));
        await page.waitForSelector('#card:visible');
        assert.equal(await page.textContent('#card h2'), 'The connection was lost');
        isDown = false;
        await page.click('#retry');
        await shows(page, () => limberViewer.state.shown?.frame === 30);
        assert.equal(await page.isVisible('#card'), false);
      },
      { allow: /net::ERR_FAILED/ },
    ));

  test('an exported page works from disk', async () => {
    const page = file('flag.html');
    execFileSync(program, ['view', file('a flag & more.limber'), '--export', page]);
    assert.throws(() => execFileSync(program, ['view', file('a flag & more.limber'), '--export', page], { stdio: 'pipe' }));
    await withPage(pathToFileURL(page).href, async (opened) => {
      await shows(opened, () => limberViewer.state.framesShown > 3);
      assert.equal(await opened.textContent('#name'), 'a flag & more.limber');
    });
  });

  test('names are no trouble in addresses', async () => {
    await withPage(`${await view(file('a flag & more.limber'))}#paused`, async (page) => {
      await firstPicture(page);
      assert.equal(await page.textContent('#name'), 'a flag & more.limber');
    });
  });

  test('it fits a phone', () =>
    withPage(
      `${url}#paused`,
      async (page) => {
        await firstPicture(page);
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.equal(overflow, 0);
        for (const id of ['#play', '#timeline', '#more']) {
          const box = await page.locator(id).boundingBox();
          assert.ok(box.x >= 0 && box.x + box.width <= 390 && box.y + box.height <= 780, id);
          assert.ok(box.height >= 40, `${id} is large enough for a finger`);
        }
        assert.equal(await page.isVisible('#fit'), false);
        await page.tap('#more');
        await page.waitForSelector('#fit:visible');
        await page.tap('#compare >> text=Split');
        await shows(page, () => limberViewer.state.compare === 'split');
      },
      { viewport: { width: 390, height: 780 }, isTouch: true },
    ));

  test('it plays without long tasks of its own, in steady memory', () =>
    withPage(
      `${url}#triangles=2000&flash`,
      async (page) => {
        await shows(page, () => limberViewer.state.framesShown > 30);
        const seconds = Number(process.env.LIMBER_PLAY_SECONDS ?? 6);
        const { frames, own, heapGrowth, residentGrowth } = await measurePlay(page, launched.pid, seconds);
        assert.ok(frames > seconds, `${frames} frames in ${seconds} s`);
        assert.ok(heapGrowth < 1 << 20, `${heapGrowth} bytes more on the heap`);
        assert.ok(residentGrowth < 64 << 20, `${residentGrowth} bytes more are resident`);
        // Wall time, on a machine that may do much else: the median is the viewer's, the worst is not.
        assert.ok(quantile(own, 0.5) < 50, `${quantile(own, 0.5)} ms for a frame`);
      },
      { viewport: { width: 480, height: 320 } },
    ));

  test('the example with THREE.Mesh runs', async () => {
    const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
    const files = createServer((asked, answer) => {
      const { pathname } = new URL(asked.url, 'http://x');
      const path = pathname === '/stream.limber' ? file('gallop.limber') : join(web, pathname);
      if (!existsSync(path)) return answer.writeHead(404).end();
      answer.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' }).end(readFileSync(path));
    });
    await new Promise((resolve) => files.listen(0, '127.0.0.1', resolve));
    try {
      await withPage(`http://127.0.0.1:${files.address().port}/package/example.html`, async (page) => {
        await shows(page, () => globalThis.horse?.data?.frame > 2);
        assert.ok((await page.evaluate(() => horse.data.triangleCount)) <= 2000);
      }, { allow: /favicon|404/ });
    } finally {
      files.close();
    }
  });
});
