// A figure's name, caption and numbers in the forms that files have.

/** Letters, digits, '_' and '-' of a text, for the name of a file: "phong_rdf-n128-povray-difference". */
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
