"use strict";
// The style sheet moves the pictures by itself; this lets a reader stop and look. Where something differs, the pictures
// stand still at the pose that differs most. `before` is what an earlier player of the same page answered: where its
// reader has chosen a pose, the new one goes on there.
const movePictures = (player, before) => {
  const sheets = [...player.querySelectorAll(".sheet")];
  const [button] = player.getElementsByTagName("button");
  const [output] = player.getElementsByTagName("output");
  const [slider] = player.getElementsByTagName("input");
  const captions = [...player.querySelectorAll(".strip i")];
  const poses = Number(slider.max) + 1;
  const animations = sheets.flatMap((sheet) => sheet.getAnimations());

  if (animations.length === sheets.length) {
    const { duration: cycle, delay } = animations[0].effect.getComputedTiming();
    const playing = () => animations[0].playState === "running";

    const show = (pose) => {
      slider.value = pose;
      captions.forEach((cell, index) => cell.classList.toggle("now", index === pose));
      const caption = captions[pose]?.dataset.caption ?? "";
      output.textContent = caption;
      slider.setAttribute("aria-valuetext", caption);
    };
    const seek = (pose) => {
      // Half a pose in, so that no rounding shows a neighbour.
      animations.forEach((animation) => { animation.currentTime = delay + (pose + 0.5) * cycle / poses; });
      show(pose);
    };
    const set = (play) => {
      animations.forEach((animation) => { play ? animation.play() : animation.pause(); });
      player.classList.toggle("paused", !play);
      button.lastElementChild.textContent = play ? button.dataset.pause : button.dataset.play;
      if (play) requestAnimationFrame(follow);
    };
    const follow = () => {
      if (!playing()) return;
      const time = (animations[0].currentTime ?? 0) - delay;
      const pose = Math.floor((time % cycle) / cycle * poses);
      if (pose !== Number(slider.value)) show(pose);
      requestAnimationFrame(follow);
    };

    let chosen = before?.chosen() ?? false;
    const choose = (play, pose) => {
      chosen = true;
      set(play);
      if (pose !== undefined) seek(pose);
    };
    button.addEventListener("click", () => choose(!playing()));
    slider.addEventListener("input", () => choose(false, Number(slider.value)));
    captions.forEach((cell, index) => cell.addEventListener("click", () => choose(false, index)));
    button.parentElement.hidden = slider.hidden = false;

    const asked = /^#pose=(\d+)$/.exec(location.hash)?.[1];
    const start = chosen ? before.pose() : asked ?? player.dataset.start;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    seek(Math.min(Number(start ?? 0), poses - 1));
    set(chosen ? before.playing() : start === undefined && !still);
    return { pose: () => Number(slider.value), playing, chosen: () => chosen };
  }
  return undefined;
};
{
  const player = document.getElementById("player");
  if (player) movePictures(player);
}
