// node build.mjs ENGINE PACKAGE TITLE OUT.html: one page with an engine of node_modules and its script in it.
import { build } from 'esbuild';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [engine, packageName, title, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const { version } = JSON.parse(readFileSync(join(here, 'node_modules', packageName, 'package.json')));
const { outputFiles } = await build({
  entryPoints: [join(here, `${engine}.js`)], bundle: true, minify: true, format: 'iife', write: false, logLevel: 'error',
  legalComments: 'inline',
});
const script = outputFiles[0].text.replaceAll('</script', '<\\/script');
writeFileSync(out, `<!doctype html>\n<meta charset="utf-8">\n<title>${title} ${version}</title>\n<script>${script}</script>\n`);
