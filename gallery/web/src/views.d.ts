// views/NAME.ts exports a function NAME, and build.mjs makes this list from the folder. A page names its own view as
// <body data-view="NAME">.

/** Called once, when the page and its data are loaded. `main` holds the page as it is without script. */
declare const views: Readonly<Record<string, (main: HTMLElement) => void>>;
export default views;
