import { pageData } from '../lib/data';

export function grid(main: HTMLElement): void {
  pageData();
  void main;
}
