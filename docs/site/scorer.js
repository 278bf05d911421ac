/* How results of a search are ordered: see html_search_scorer of Sphinx. Who searches wants to do something first. */
"use strict";

var Scorer = {
  /* What a match counts, as in Sphinx. */
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,

  /* By what it is multiplied, by folder. A word in the text of a how-to (5) comes before one in a heading elsewhere (15),
     but after a page whose title is just this word (16 and more). */
  weights: { "how-to": 4, start: 3, theory: 1.2, reference: 1.2, gallery: 1.2 },
  /* The same for names of the interface: one such as ContactProblem or load_at_yield (16) is not asked for by chance. */
  names: { plain: 1.2, compound: 1.5 },
  /* Is added where the title of the page, not only a heading of it, is the words that are asked for; a half of it where it
     has them among many others. */
  inTitle: 1.5,

  score: ([page, title, , , score, , kind]) => {
    if (kind === "object") {
      const compound = /[a-z][A-Z]|_/.test(title.split(".").pop());
      return score * Scorer.names[compound ? "compound" : "plain"];
    }
    if (page.endsWith("index")) return score;
    const asked = new URLSearchParams(window.location.search).get("q") ?? "";
    const words = asked.toLowerCase().split(/\W+/).filter((word) => word.length > 2);
    const own = title.split(" > ")[0].toLowerCase();
    const had = words.filter((word) => own.includes(word.slice(0, Math.max(4, word.length - 2)))).length;
    const share = (had / Math.max(words.length, 1)) * (0.5 + (0.5 * had) / own.split(/\W+/).length);
    return (score + Scorer.inTitle * share) * (Scorer.weights[page.split("/")[0]] ?? 1);
  },
};
