// SPDX-License-Identifier: Apache-2.0
// The time of a drive that all its views show: replay, film, plots, map.

class DriveClock {
  constructor(end_s) {
    this.end_s = end_s;
    this.time_s = 0;
    this.speed = 1;
    this.playing = false;
    this.listeners = [];
    this.frame = 0;  // the next, of the browser's
    this.driver = null;  // what keeps the time while it plays, {play(speed), pause()}; null: this does
  }
  onTime(listener) { this.listeners.push(listener); }
  set(time_s) {
    this.time_s = Math.min(this.end_s, Math.max(0, time_s));
    for (const listener of this.listeners) listener(this.time_s);
  }
  setSpeed(speed) {
    this.speed = speed;
    if (this.driver && this.playing) this.driver.play(speed);
    this.set(this.time_s);
  }
  play() {
    if (this.playing) return;
    if (this.time_s >= this.end_s) this.set(0);
    this.playing = true;
    if (this.driver) {
      this.driver.play(this.speed);
      this.set(this.time_s);
      return;
    }
    let last = performance.now();
    const step = now => {
      this.frame = requestAnimationFrame(step);
      this.set(this.time_s + this.speed * Math.min(0.25, (now - last) / 1000));
      last = now;
      if (this.time_s >= this.end_s) this.pause();
    };
    this.frame = requestAnimationFrame(step);
    this.set(this.time_s);
  }
  pause() {
    this.playing = false;
    cancelAnimationFrame(this.frame);
    if (this.driver) this.driver.pause();
    this.set(this.time_s);
  }
}
