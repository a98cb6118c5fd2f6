// SPDX-License-Identifier: Apache-2.0
// The film of a drive, bound to its clock: each picture of it shows one moment, which `film_t_s` says.
// While it is looked at it leads the clock, else it follows.

class FilmPlayer {
  constructor(film, drive, clock) {
    this.film = film;
    this.drive = drive;
    this.clock = clock;
    this.home = film.parentElement;
    this.told = false;  // the film itself says the time
    const see = make('button', {type: 'button', class: 'link'}, 'plays above');
    see.addEventListener('click', () => document.getElementById('theater').scrollIntoView({behavior: 'smooth'}));
    this.absent = make('p', {class: 'note'}, 'This film ', see, '.');
    film.onplay = () => this.run();
    film.onpause = () => { if (clock.driver === this && clock.playing) clock.pause(); };
    clock.onTime(t_s => this.follow(t_s));
  }

  // Takes the film out of its place in the page, for the drive's view.
  panel() {
    this.home.append(this.absent);
    this.missing = make('p', {class: 'note', 'aria-live': 'polite'});
    return make('div', {class: 'film'}, this.film, this.missing);
  }
  // Brings it back.
  leave() {
    this.film.pause();
    this.film.onplay = this.film.onpause = null;
    this.absent.replaceWith(this.film);
  }

  // Whether it leads the clock.
  lead(leads) {
    this.clock.driver = leads && this.drive.film_t_s ? this : null;
    this.film.pause();
    this.follow(this.clock.time_s);
  }
  play(speed) {
    this.film.playbackRate = Math.min(16, speed);
    this.film.play().catch(() => {});  // it was stopped before it began
  }
  pause() { this.film.pause(); }

  // Tells the clock while it plays, by its own controls too.
  run() {
    const {film, clock, drive} = this;
    if (clock.driver !== this) return;
    clock.playing = true;
    const step = () => {
      if (film.paused || clock.driver !== this) return;
      const frame = Math.min(drive.film_t_s.length - 1, Math.floor(film.currentTime * drive.film_fps + 0.5));
      this.told = true;
      clock.set(drive.film_t_s[frame]);
      this.told = false;
      if (film.ended) clock.pause(); else requestAnimationFrame(step);
    };
    step();
  }

  // Shows the picture of a moment, or the nearest, and says so where there is none.
  follow(t_s) {
    const {film, drive, clock} = this;
    if (!drive.film_t_s) return;
    const [before] = stateAt(drive.film_t_s, t_s);
    const after = Math.min(before + 1, drive.film_t_s.length - 1);
    const off = frame => Math.abs(drive.film_t_s[frame] - t_s);
    const frame = off(after) < off(before) ? after : before;
    if (this.missing)
      this.missing.textContent = off(frame) > 5
          ? `${t_s.toFixed(1)} s was not filmed; the nearest picture is of ${drive.film_t_s[frame].toFixed(1)} s.` : '';
    if (!this.told && !(clock.playing && clock.driver !== this)) film.currentTime = frame / drive.film_fps;
  }
}
