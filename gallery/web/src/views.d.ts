// The views that have something to start on their page: views/NAME.ts exports a function NAME, and build.mjs makes this
// list of the folder. A page names its own as <body data-view="NAME">.

/** Called once, when the page and its data are there. `main` holds the page as it is without script. */
export type View = (main: HTMLElement) => void;

declare const views: Readonly<Record<string, View>>;
export default views;
