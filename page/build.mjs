// Bundles the page into one HTML file whose mark <!--RUN--> is where a run goes in.
//   node build.mjs OUT.html
import { build } from 'esbuild';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (out === undefined) {
  console.error('usage: node build.mjs OUT.html');
  process.exit(2);
}

const common = { bundle: true, write: false, minify: true, target: 'es2022', legalComments: 'none', logLevel: 'warning', charset: 'ascii' };

/** import code from 'worker:./file.ts': that script, bundled on its own, as text. */
const workers = {
  name: 'workers',
  setup(b) {
    b.onResolve({ filter: /^worker:/ }, (args) => ({
      path: path.join(args.resolveDir, args.path.slice('worker:'.length)),
      namespace: 'worker',
    }));
    b.onLoad({ filter: /.*/, namespace: 'worker' }, async (args) => {
      const script = await build({ ...common, entryPoints: [args.path], format: 'iife' });
      return { contents: script.outputFiles[0].text, loader: 'text' };
    });
  },
};

const script = await build({
  ...common, entryPoints: [path.join(here, 'src/main.ts')], format: 'esm', plugins: [workers], loader: { '.css': 'text' },
});
const style = await build({ ...common, entryPoints: [path.join(here, 'style.css')] });

/** Licences of what is bundled, as they ask for. */
async function licences() {
  const texts = [];
  for (const name of ['twgl.js', 'uplot']) {
    const folder = path.join(here, 'node_modules', name);
    const { version } = JSON.parse(await readFile(path.join(folder, 'package.json'), 'utf8'));
    const file = (await readdir(folder)).find((f) => /^licen[cs]e/i.test(f));
    if (file === undefined) throw new Error(`${name} comes without its licence`);
    texts.push(`${name} ${version}\n\n${(await readFile(path.join(folder, file), 'utf8')).trim()}`);
  }
  return `<!--\nThis page contains:\n\n${texts.join('\n\n').replaceAll('--', '- -')}\n-->`;
}

const notes = await licences();
const page = await readFile(path.join(here, 'index.html'), 'utf8');
// A function as replacement: "$" in the script means nothing special.
const filled = page
  .replace('<!--LICENCES-->', () => notes)
  .replace('/*STYLE*/', () => style.outputFiles[0].text.trim())
  .replace('/*SCRIPT*/', () => script.outputFiles[0].text.replaceAll('</script', '<\\/script').trim());
await writeFile(out, filled);
