// SPDX-License-Identifier: Apache-2.0
// The time of a drive that all its views show: replay, film, plots, map.

class DriveClock {
  constructor(end_s) {
    this.end_s = end_s;
    this.time_s = 0;
    this.speed = 1;
    this.playing = false;
    this.listeners = [];
  }
  onTime(listener) { this.listeners.push(listener); }
  // `by`: the view that says so; it is not told.
  set(time_s, by = null) {
    this.time_s = Math.min(this.end_s, Math.max(0, time_s));
    for (const listener of this.listeners) if (listener !== by) listener(this.time_s);
  }
  play() {
    if (this.playing) return;
    if (this.time_s >= this.end_s) this.set(0);
    this.playing = true;
    let last = performance.now();
    const step = now => {
      if (!this.playing) return;
      this.set(this.time_s + this.speed * Math.min(0.25, (now - last) / 1000));
      last = now;
      if (this.time_s >= this.end_s) this.pause(); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.set(this.time_s);
  }
  pause() {
    this.playing = false;
    this.set(this.time_s);
  }
}
