// A region that scrolls can be reached by the keyboard.
function focusable() {
  for (const region of document.querySelectorAll("pre, .formula, .table-wrapper, .output_area, .cell_output > *")) {
    if (region.scrollWidth > region.clientWidth || region.scrollHeight > region.clientHeight) {
      region.tabIndex = 0;
    }
  }
}
addEventListener("load", focusable);
addEventListener("resize", focusable);
