// SPDX-License-Identifier: MIT
// Formulas of the C++ reference by KaTeX. Doxygen's pages load this file under the name of MathJax.
for (const [kind, name] of [["link", "../katex/katex.min.css"], ["script", "../katex/katex.min.js"], ["script", "../katex/contrib/auto-render.js"]]) {
    const element = document.createElement(kind);
    if (kind === "link") {
        element.rel = "stylesheet";
        element.href = name;
    } else {
        element.src = name;
        element.async = false;  // in this order
    }
    document.head.appendChild(element);
}
window.addEventListener("load", () => renderMathInElement(document.body, {
    delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}],
    throwOnError: false
}));
