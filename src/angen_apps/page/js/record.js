/** Pictures and videos of the home, as the browser shows it: its view, the names in it and the clock. */
import { by, el, notice } from './dom.js';
import { t } from './lang.js';

const FRAMES = 25, PLAN = 200; // per second; ms between pictures of the plan
const TYPES = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];

/** @param {Blob} blob @param {string} name */
function save(blob, name) {
  const link = el('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** @param {any} page @param {string} kind of the file */
const nameOf = (page, kind) => `angen_${page.home.clock(page.home.stats.time).replaceAll(':', '')}.${kind}`;

export class Recorder {
  /** @param {any} page */
  constructor(page) {
    this.page = page;
    this.canvas = el('canvas');
    this.sharp = Math.min(2, devicePixelRatio);
    /** @type {MediaRecorder | null} */
    this.recorder = null;
    this.bytes = 0; // of the video
  }

  async picture() {
    await this.compose(true);
    this.canvas.toBlob((/** @type {Blob} */ blob) => save(blob, nameOf(this.page, 'png')));
  }

  /** Begins a video, or ends it. @returns {boolean} whether it records */
  toggle() {
    if (this.recorder) { this.recorder.stop(); return false; }
    const type = TYPES.find((one) => window.MediaRecorder?.isTypeSupported(one));
    if (!type) { notice(t('This browser records no videos: angen web --video does.'), true); return false; }
    const { view } = this.page, parts = /** @type {Blob[]} */ ([]), recorder = new MediaRecorder(this.canvas.captureStream(FRAMES), { mimeType: type, videoBitsPerSecond: 6e6 });
    if (view) view.after = () => this.compose(false);
    const again = async () => {
      if (this.recorder !== recorder) return;
      const began = performance.now();
      if (!this.page.plan.hidden) await this.compose(false);
      setTimeout(again, Math.max(PLAN, 2 * (performance.now() - began))); // other work needs some time too
    };
    this.bytes = 0;
    recorder.ondataavailable = (e) => { parts.push(e.data); this.bytes += e.data.size; };
    recorder.onstop = () => {
      if (view) view.after = () => {};
      this.recorder = null;
      if (!this.bytes) notice(t('The browser had no time to record: angen web --video takes its time.'), true);
      else save(new Blob(parts, { type }), nameOf(this.page, type.includes('mp4') ? 'mp4' : 'webm'));
    };
    recorder.start(1000);
    this.recorder = recorder;
    this.compose(true).then(again);
    return true;
  }

  /**
   * Draws what is shown.
   * @param {boolean} again whether the view is drawn for it
   */
  async compose(again) {
    const { page, canvas, sharp } = this, { view, plan } = page, stage = by('stage'), { clientWidth: width, clientHeight: height } = stage;
    if (canvas.width !== Math.round(width * sharp) || canvas.height !== Math.round(height * sharp)) { canvas.width = Math.round(width * sharp); canvas.height = Math.round(height * sharp); }
    const shown = plan.hidden ? view?.renderer.domElement : await this.planImage();
    const context = canvas.getContext('2d'), style = getComputedStyle(document.documentElement), from = stage.getBoundingClientRect();
    context.setTransform(sharp, 0, 0, sharp, 0, 0);
    context.fillStyle = style.getPropertyValue('--bg');
    context.fillRect(0, 0, width, height);
    if (plan.hidden && again) view.draw(); // the browser clears what it has shown
    if (shown) {
      const box = (plan.hidden ? shown : plan.root).getBoundingClientRect();
      context.drawImage(shown, box.left - from.left, box.top - from.top, box.width, box.height);
    }
    context.textBaseline = 'middle';
    if (plan.hidden) for (const label of by('labels').children) this.write(context, label, from);
    context.font = '600 17px system-ui';
    context.fillStyle = style.getPropertyValue('--ink');
    context.textAlign = 'right';
    context.fillText(page.home.clock(page.home.stats.time), width - 14, 20);
    context.textAlign = 'left';
  }

  /** @param {any} context @param {any} label @param {DOMRect} from */
  write(context, label, from) {
    const style = getComputedStyle(label), box = label.getBoundingClientRect();
    if (style.visibility === 'hidden' || !box.width) return;
    context.fillStyle = style.backgroundColor;
    context.beginPath();
    context.roundRect(box.left - from.left, box.top - from.top, box.width, box.height, box.height / 2);
    context.fill();
    let x = box.left - from.left + parseFloat(style.paddingLeft);
    for (const node of label.childNodes) {
      const own = node.nodeType === Node.TEXT_NODE ? style : getComputedStyle(node), text = node.textContent ?? '';
      context.font = `${own.fontWeight} ${own.fontSize} ${own.fontFamily}`;
      context.fillStyle = own.color;
      x += node === label.firstChild ? 0 : parseFloat(own.marginLeft) || 0;
      context.fillText(text, x, box.top - from.top + box.height / 2);
      x += context.measureText(text).width;
    }
  }

  /** @returns {Promise<HTMLImageElement | null>} the plan, with the styles that it has in the page */
  async planImage() {
    const { root } = this.page.plan;
    if (!root) return null;
    const copy = root.cloneNode(true), box = root.getBoundingClientRect(), theme = getComputedStyle(document.documentElement);
    const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]).map((rule) => rule.cssText);
    const values = ['bg', 'surface', 'line', 'edge', 'ink', 'soft', 'accent', 'accent-soft', 'warn', 'lamp-soft', 'room', 'wall', 'robot'].map((name) => `--${name}: ${theme.getPropertyValue(`--${name}`)};`);
    const sheet = document.createElementNS('http://www.w3.org/2000/svg', 'style');
    sheet.textContent = `${rules.filter((rule) => /^(svg|#plan svg) /.test(rule)).join('\n').replaceAll('#plan ', '')}\nsvg { ${values.join(' ')} font-family: ${getComputedStyle(document.body).fontFamily}; }`;
    copy.prepend(sheet);
    copy.setAttribute('width', box.width * this.sharp);
    copy.setAttribute('height', box.height * this.sharp);
    const url = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(copy)], { type: 'image/svg+xml' }));
    const image = new Image();
    image.src = url;
    await image.decode();
    URL.revokeObjectURL(url);
    return image;
  }
}
