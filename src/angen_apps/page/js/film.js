/** Frames at given times of a recording, for angen web --video: the page stands still between them. */

const frames = async (/** @type {number} */ count) => { for (let i = 0; i < count; i++) await new Promise(requestAnimationFrame); };

/**
 * Shows the home alone, as it is at a time.
 * @param {any} page @param {string} view 3d or plan @param {number} time s @param {boolean} withLine whether the time line is shown
 */
export async function begin(page, view, time, withLine) {
  const { player } = page;
  document.body.classList.add('film');
  document.body.classList.toggle('bare', !withLine);
  player.playing = false;
  page.setTheme('light');
  page.setView(view);
  player.seek(time);
  page.begun = false;
  page.begin(); // on the floor with people at that time
  await frames(2); // until its size is known
  if (page.view) page.view.held = true;
  page.whole();
  page.film = async (/** @type {number} */ at, /** @type {number} */ dt) => {
    player.seek(at);
    page.view?.film(dt);
    page.plan.update();
    page.showClock();
    player.frame();
    if (player.ribbonStale) { player.ribbonStale = false; player.drawRibbon(); }
    await frames(2); // until it is on the screen
  };
}
