// Thumbnails of a site in few files: each file has those of neighbouring cells, and is loaded when one comes into view.
import { load } from '../lib/data';
import { inflated } from '../lib/inflate';
import { PackedPixels } from '../lib/packed_pixels';
import type { Thumbnails as File } from '../records';

const kCellsOfFile = 100;  // gallery/packed/packed_cells.hpp
const kMostFiles = 100;  // kept as they are, 25 KB each as a rule
const kMostOpen = 12;  // kept ready, 1.2 MB each
const kMostAddresses = 1500;  // kept, 16 KB each
const kSlice = 8;  // milliseconds of decoding before the reader's next key has its turn
const kNothing = 'data:image/gif;base64,R0lGODlhAQABAIAAAAAAAAAAACH5BAAAAAAALAAAAAABAAEAAAICRAEAOw==';

/** What was used longest ago goes first. */
class Recent<T> {
  private readonly all = new Map<number, T>();
  constructor(private readonly most: number) {}
  /** Undefined if it is not kept. */
  get(key: number): T | undefined { return this.all.get(key); }
  of(key: number, make: () => T): T {
    const value = this.all.get(key) ?? make();
    this.all.delete(key);
    this.all.set(key, value);
    if (this.all.size > this.most) this.all.delete(this.all.keys().next().value!);
    return value;
  }
}

export async function openThumbnails({ widths, heights, ways, pixels }: File): Promise<PackedPixels> {
  return new PackedPixels(widths.map((width, i) => ({ width, height: heights[i]!, way: ways[i]! })), await inflated(pixels));
}

export class Thumbnails {
  private readonly files = new Recent<Promise<File>>(kMostFiles);
  private readonly opened = new Recent<Promise<PackedPixels>>(kMostOpen);

  private readonly addresses = new Recent<string>(kMostAddresses);
  private readonly waiting: { image: HTMLImageElement; place: number; pictures: PackedPixels }[] = [];
  private isAsked = false;

  paint(image: HTMLImageElement, place: number): void {
    const known = this.addresses.get(place), number = Math.floor(place / kCellsOfFile);
    image.src = known ?? kNothing;
    if (known !== undefined) return;
    void this.opened.of(number, () => this.file(number).then(openThumbnails))
      .then((pictures) => { this.waiting.push({ image, place, pictures }); this.ask(); }, () => { image.classList.add('lost'); });
  }

  private ask(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    setTimeout(() => { this.isAsked = false; this.decode(); });
  }

  private decode(): void {
    for (const end = performance.now() + kSlice; performance.now() < end && this.waiting.length > 0;) {
      const { image, place, pictures } = this.waiting.shift()!;
      image.src = this.addresses.of(place, () => pictures.address(place % kCellsOfFile));
    }
    if (this.waiting.length > 0) this.ask();
  }

  private file(number: number): Promise<File> {
    return this.files.of(number, () => load<File>(`thumbnails.${number}`, `packed/${number}.thumbnails.data.js`));
  }
}
