"use strict";
// Escape closes the menu that is open, as it does elsewhere; the focus goes back to what opened it.
document.addEventListener("keydown", (event) => {
  const menu = document.querySelector(".top .menu[open]");
  if (event.key !== "Escape" || event.isComposing || !menu) return;
  const hadFocus = menu.contains(document.activeElement);
  menu.open = false;
  if (hadFocus) menu.querySelector("summary").focus();
});
