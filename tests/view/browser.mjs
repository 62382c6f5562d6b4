// A browser with a page in it, for tests and benchmarks: Debian's Chromium, without a display.
import { createRequire } from 'node:module';
import path from 'node:path';

/** `packages`: the folder whose node_modules has playwright-core. */
export async function launch(packages) {
  const require = createRequire(path.join(path.resolve(packages), 'package.json'));
  const { chromium } = require('playwright-core');
  return chromium.launch({
    executablePath: '/usr/bin/chromium',
    args: [
      '--no-sandbox', // the only way for root
      '--enable-unsafe-swiftshader', // WebGL without a graphics card
      '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync',
    ],
  });
}

/** A page with nothing in it yet. What goes wrong on it is added to `faults`. */
export async function blank(browser, faults) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.setDefaultTimeout(60000); // a busy machine may need half of it
  page.on('console', (message) => {
    // What reading pixels back costs is the tests' own doing.
    if (['error', 'warning'].includes(message.type()) && !message.text().includes('ReadPixels')) faults.push(message.text());
  });
  page.on('pageerror', (error) => faults.push(error.message));
  return page;
}

/** Opens a page and waits for its first drawing. */
export async function open(browser, address, faults) {
  const page = await blank(browser, faults);
  page.on('request', (request) => {
    if (address.startsWith('file:') && !/^(file|blob|data):/.test(request.url())) faults.push(`asks for ${request.url()}`);
  });
  await page.goto(address);
  await page.waitForFunction(() => window.edda?.drawn > 0, null, { timeout: 60000 });
  return page;
}
