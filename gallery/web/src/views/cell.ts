import { pageData } from '../lib/data';

export function cell(main: HTMLElement): void {
  pageData();
  void main;
}
