// Bundles src/ into dist/gallery.js and dist/gallery.css, which are committed: the program that
// embeds them is built without node. `node build.mjs DIR` writes elsewhere; a test compares the two.
import { build } from 'esbuild';
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import path from 'node:path';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.resolve(process.argv[2] ?? path.join(here, 'dist'));

/** The module './views' (src/views.d.ts), from the files in src/views. */
const views = {
  name: 'views',
  setup(builder) {
    const source = path.join(here, 'src');
    builder.onResolve({ filter: /^\.\/views$/ }, () => ({ path: 'views', namespace: 'views' }));
    builder.onLoad({ filter: /.*/, namespace: 'views' }, () => {
      const names = readdirSync(path.join(source, 'views')).sort().map((file) => path.parse(file).name);
      const imports = names.map((name) => `import { ${name} } from './views/${name}';`);
      return { contents: `${imports.join('\n')}\nexport default { ${names.join(', ')} };`, resolveDir: source };
    });
  },
};

await build({
  absWorkingDir: here,
  entryPoints: { gallery: 'src/main.ts' },
  bundle: true,
  minify: true,
  // A classic script: browsers refuse modules on file://.
  format: 'iife',
  target: ['es2022', 'chrome108', 'firefox113', 'safari16.4'],
  charset: 'utf8',
  legalComments: 'none',
  logLevel: 'warning',
  outdir: out,
  plugins: [views],
});
