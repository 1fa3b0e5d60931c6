// A figure's name, caption and numbers in the forms that files have.

/** Letters, digits, '_' and '-' of a text, for the name of a file: "phong_rdf-n128-povray-difference". LaTeX would take a point for the start of an ending. */
export function fileName(...parts: readonly string[]): string {
  const words = parts.map((part) => part.normalize('NFKD').replace(/[^A-Za-z0-9_]+/g, '-').replace(/^-+|-+$/g, ''));
  return words.filter(Boolean).join('-').slice(0, 120) || 'figure';
}

/** A field of a CSV file. A spreadsheet would run a text that begins as a formula does. */
function field(value: string | number): string {
  if (typeof value === 'number') return Number.isFinite(value) ? String(value) : Number.isNaN(value) ? 'nan' : value > 0 ? 'inf' : '-inf';
  const text = /^[=+@\t-]/.test(value) ? "'" + value : value;
  return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

export function csvText(rows: Iterable<readonly (string | number)[]>): string {
  let text = '';
  for (const row of rows) text += row.map(field).join(',') + '\n';
  return text;
}

const kSpecial: Readonly<Record<string, string>> = {
  '\\': '\\textbackslash{}', '{': '\\{', '}': '\\}', '$': '\\$', '&': '\\&', '#': '\\#', '%': '\\%', '_': '\\_',
  '^': '\\textasciicircum{}', '~': '\\textasciitilde{}', '<': '\\textless{}', '>': '\\textgreater{}', '|': '\\textbar{}',
  '"': "''", '−': '$-$', '×': '$\\times$', '·': '$\\cdot$', '°': '$^\\circ$', '√': '$\\surd$', '≥': '$\\geq$', '≤': '$\\leq$', '±': '$\\pm$', '∞': '$\\infty$',
  'θ': '$\\theta$', 'π': '$\\pi$', 'α': '$\\alpha$', 'σ': '$\\sigma$', 'Δ': '$\\Delta$', '…': '\\ldots{}', '–': '--', '\u202f': '\\,', '\u00a0': '~',
};
const kRaised: Readonly<Record<string, string>> = Object.fromEntries([...'⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ⁺⁽⁾'].map((c, i) => [c, '0123456789-n+()'[i]!]));

/** Text for LaTeX, as it is read: nothing in it is a command. */
export function latexText(text: string): string {
  return text.replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ⁺⁽⁾]+/g, (run) => `\u0001${[...run].map((c) => kRaised[c]).join('')}\u0002`)
    .replace(/\s+/g, ' ')
    .replace(/[^\u0001\u0002]/gu, (c) => kSpecial[c] ?? c)
    .replace(/\u0001/g, '$^{').replace(/\u0002/g, '}$');
}

export function latexFigure(name: string, caption: string): string {
  return `\\begin{figure}\n  \\centering\n  \\includegraphics[width=\\linewidth]{${name}}\n  \\caption{${latexText(caption)}}\n` +
    `  \\label{fig:${name}}\n\\end{figure}\n`;
}

/** Lines of about `width` characters. */
export function wrapped(text: string, width: number): string[] {
  const lines = [''];
  for (const word of text.split(/ +/)) {
    const last = lines[lines.length - 1]!;
    if (last !== '' && last.length + 1 + word.length > width) lines.push(word);
    else lines[lines.length - 1] = last === '' ? word : `${last} ${word}`;
  }
  return lines;
}
