/** What the page's modules read of a browser when they are loaded, in node. */
const nothing = () => null;
globalThis.document = { querySelector: nothing, querySelectorAll: () => [], getElementById: nothing, addEventListener: nothing, documentElement: {} };
globalThis.localStorage = { getItem: nothing, setItem: nothing };
globalThis.location = { search: '', href: 'http://localhost/', host: 'localhost', protocol: 'http:', pathname: '/' };
globalThis.navigator ??= { languages: ['en'] };
globalThis.window = globalThis;
globalThis.requestAnimationFrame = nothing;
globalThis.addEventListener = nothing;
globalThis.matchMedia = () => ({ matches: false, addEventListener: nothing });
