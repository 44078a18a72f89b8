"use strict";
// Live figures: the engine replaces a film when it comes into view, and pauses out of sight. At most two figures run; a
// third replaces the one that started first. If a film has several figures, buttons choose one. Without this script, and
// on paper, the film stays.
(() => {
  const MOST = 2, SEEN = 0.3;  // running figures; part of a figure that counts as seen
  const seen = [];  // running figures, in the order in which they started
  const films = [...document.querySelectorAll("figure[data-live]")];
  if (!films.length) return;

  for (const film of films) {
    film.runs = JSON.parse(film.dataset.live);
    film.chosen = film.runs[0];
  }

  const nameOf = ({ scene }) => scene.replaceAll("_", " ");

  /** Loads the chosen figure. The first one stays hidden until its first picture. */
  function load(figure) {
    const frame = document.createElement("iframe");
    frame.title = `${nameOf(figure.chosen)}, running`;
    frame.src = `${window.bookRoot}assets/live.html#${encodeURIComponent(JSON.stringify(figure.chosen))}`;
    if (figure.frame) figure.frame.replaceWith(frame);
    else figure.prepend(frame);
    figure.frame = frame;
    figure.begun = false;
  }

  /** Shows a button for each figure of a film. */
  function offer(figure) {
    if (figure.runs.length < 2 || figure.querySelector(".scenes")) return;
    const line = document.createElement("p");
    line.className = "scenes";
    for (const run of figure.runs) {
      const button = document.createElement("button");
      button.textContent = nameOf(run);
      button.setAttribute("aria-pressed", run === figure.chosen);
      button.onclick = () => {
        if (run === figure.chosen) return;
        figure.chosen = run;
        for (const other of line.children) other.setAttribute("aria-pressed", other === button);
        load(figure);
      };
      line.append(button);
    }
    figure.prepend(line);
  }

  function say(figure, text) {
    const line = figure.querySelector(".says") || document.createElement("p");
    line.className = "says";
    line.textContent = text;
    figure.insertBefore(line, figure.querySelector("figcaption"));
  }

  function tell() {
    const running = document.hidden ? [] : seen.slice(-MOST);
    for (const figure of films) {
      if (!figure.frame && !figure.lost && running.includes(figure)) load(figure);
      if (figure.begun) figure.frame.contentWindow.postMessage({ seen: running.includes(figure) }, "*");
    }
  }

  window.addEventListener("message", ({ source, data }) => {
    const figure = films.find((film) => film.frame && film.frame.contentWindow === source);
    if (!figure) return;
    if (data.begun) {
      figure.begun = true;
      figure.classList.add("running");
      // The caption describes the first, which is that of the film.
      const other = figure.chosen !== figure.runs[0];
      figure.classList.toggle("other", other);
      say(figure, other ? `${data.summary} ${figure.chosen.says}` : figure.chosen.says);
      offer(figure);
      tell();
    } else if (data.lost) {
      figure.lost = true;
      figure.begun = false;
      figure.classList.remove("running", "other");
      if (figure.querySelector(".scenes")) figure.querySelector(".scenes").remove();
      figure.frame.remove();
      figure.frame = null;
      say(figure, `${data.lost} The film is shown instead.`);
    }
  });
  document.addEventListener("visibilitychange", tell);

  const observer = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const at = seen.indexOf(target);
      if (at >= 0) seen.splice(at, 1);
      if (isIntersecting) seen.push(target);
    }
    tell();
  }, { threshold: SEEN });
  for (const film of films) observer.observe(film);
})();
