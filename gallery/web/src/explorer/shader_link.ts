// A shader in a link: deflated, in base64 for addresses. What a link holds is somebody's text, and bounded.
const kMostLetters = 20_000, kMostPacked = 12_000;

async function through(stream: { readable: ReadableStream<Uint8Array>; writable: WritableStream<BufferSource> }, bytes: Uint8Array<ArrayBuffer>, most: number): Promise<Uint8Array<ArrayBuffer>> {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader(), parts: Uint8Array[] = [];
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new Error('too long');
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts as BlobPart[]).arrayBuffer());
}

/** Throws if the shader is too long for a link. */
export async function packed(text: string): Promise<string> {
  const small = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(text), kMostPacked);
  if (text.length > kMostLetters) throw new Error('too long');
  let letters = '';
  for (const byte of small) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** Undefined if it is none. */
export async function unpacked(words: string): Promise<string | undefined> {
  if (!/^[\w-]+$/.test(words) || words.length > 1.4 * kMostPacked) return undefined;
  try {
    const bytes = Uint8Array.from(atob(words.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
    return new TextDecoder('utf-8', { fatal: true }).decode(await through(new DecompressionStream('deflate-raw'), bytes, 4 * kMostLetters));
  } catch {
    return undefined;
  }
}
