"use strict";
// The style sheet moves the pictures by itself; this lets a reader stop and look. `before` is what an earlier player
// of the same page answered: the new one goes on where that one is.
const movePictures = (player, before) => {
  const sheets = [...player.querySelectorAll(".sheet")];
  const [button] = player.getElementsByTagName("button");
  const [output] = player.getElementsByTagName("output");
  const [slider] = player.getElementsByTagName("input");
  const captions = [...player.querySelectorAll(".strip i")];
  const poses = Number(slider.max) + 1;
  const animations = sheets.flatMap((sheet) => sheet.getAnimations());

  if (animations.length === sheets.length) {
    const cycle = animations[0].effect.getComputedTiming().duration;
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
      animations.forEach((animation) => { animation.currentTime = (pose + 0.5) * cycle / poses; });
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
      const time = animations[0].currentTime ?? 0;
      const pose = Math.floor((time % cycle) / cycle * poses);
      if (pose !== Number(slider.value)) show(pose);
      requestAnimationFrame(follow);
    };

    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const asked = /^#pose=(\d+)$/.exec(location.hash);
    button.addEventListener("click", () => set(!playing()));
    slider.addEventListener("input", () => { set(false); seek(Number(slider.value)); });
    captions.forEach((cell, index) => cell.addEventListener("click", () => { set(false); seek(index); }));
    button.parentElement.hidden = slider.hidden = false;
    seek(before ? Math.min(before.pose(), poses - 1) : asked ? Math.min(Number(asked[1]), poses - 1) : 0);
    set(before ? before.playing() : !still && !asked);
    return { pose: () => Number(slider.value), playing };
  }
  return undefined;
};
{
  const player = document.getElementById("player");
  if (player) movePictures(player);
}
