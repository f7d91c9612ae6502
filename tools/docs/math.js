// SPDX-License-Identifier: MIT
// Formulas: $...$ and $$...$$ of the pages, which arithmatex writes as \(...\) and \[...\].
document.addEventListener("DOMContentLoaded", () => renderMathInElement(document.body, {
    delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}],
    throwOnError: false
}));
