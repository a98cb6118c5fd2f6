// SPDX-License-Identifier: Apache-2.0
// One drive on the page: its replay or film, the controls of its time, its curves.

const kSpeeds = [0.25, 1, 4, 16, 64];
const clockText = t_s => `${t_s.toFixed(1)} s`;

// Shows drives in `element`, one at a time, and their curves in `curves`. `onTime(place, drive)`:
// where the robot is now.
class DriveView {
  constructor(element, curves, onTime) {
    this.element = element;
    this.curves = curves;
    this.onTime = onTime;
    this.canDraw = typeof THREE !== 'undefined' && hasWebGl();
  }

  show(drive) {
    if (this.clock) this.clock.pause();
    if (this.film) this.film.leave();
    if (this.view) this.view.dispose();
    this.film = this.view = this.replay = null;
    this.drive = drive;
    this.damage = '';
    try {
      if (drive.replay) this.replay = readReplay(bytesOf(document.getElementById(drive.replay).textContent));
    } catch (error) {
      this.damage = `The replay of this drive is damaged and is not shown: ${error.message}.`;
    }
    const ends = [drive.end_s || 0];
    if (this.replay) ends.push(this.replay.t_s[this.replay.t_s.length - 1]);
    this.clock = new DriveClock(Math.max(...ends));
    if (drive.film) this.film = new FilmPlayer(document.getElementById(drive.film), drive, this.clock);
    this.element.replaceChildren();
    this.curves.replaceChildren();
    this.build();
    this.clock.onTime(t_s => this.tell(t_s));
    const first = drive.events.length > 0 ? Math.max(0, drive.events[0].t_s - 0.02) : 0;
    this.clock.set(first);
    if (this.view) this.view.look(drive.events.length > 0 ? 1.6 : 2.8);
  }

  // What was planned and driven, for the map.
  ways() {
    const {replay, drive} = this;
    if (!replay) return [];
    const plan = drive.plan || replay.plan;
    return [...(plan.length > 1 ? [{name: 'plan', points: plan}] : []), {name: 'driven', points: wayOf(replay)}];
  }

  build() {
    const {drive, clock} = this;
    const stage = make('div', {class: 'stage'});
    const tabs = make('div', {class: 'tabs', role: 'tablist', 'aria-label': 'How the drive is shown'});
    const panels = [];
    const addPanel = (name, panel) => {
      const tab = make('button', {type: 'button', role: 'tab', id: `tab-${name}`, 'aria-controls': `panel-${name}`}, name);
      panel.id = `panel-${name}`;
      panel.setAttribute('role', 'tabpanel');
      panel.setAttribute('aria-labelledby', tab.id);
      const index = panels.length;
      const select = at => {
        panels.forEach((p, i) => {
          p.panel.hidden = i !== at;
          p.tab.setAttribute('aria-selected', String(i === at));
          p.tab.tabIndex = i === at ? 0 : -1;
        });
        clock.pause();
        if (this.film) this.film.lead(panels[at].tab.id === 'tab-film');
      };
      tab.addEventListener('click', () => {
        select(index);
        if (this.view) this.view.resize();
      });
      tab.addEventListener('keydown', ({key}) => {
        const to = key === 'ArrowRight' ? index + 1 : key === 'ArrowLeft' ? index - 1 : -1;
        if (to >= 0 && to < panels.length) {
          panels[to].tab.click();
          panels[to].tab.focus();
        }
      });
      panels.push({tab, panel});
      tabs.append(tab);
      stage.append(panel);
      return () => select(index);
    };

    let first = null;
    if (this.replay && this.canDraw) {
      const canvas = make('canvas', {
        tabindex: 0, role: 'img',
        'aria-label': `3D replay of ${drive.name}. Drag to orbit, wheel to zoom; arrow keys step through time.`,
      });
      const box = make('div', {class: 'canvas'}, canvas, this.viewButtons());
      first = addPanel('replay', box);
      canvas.addEventListener('keydown', event => this.onKey(event));
    }
    if (this.film) {
      const select = addPanel('film', this.film.panel());
      first = first || select;
    }
    if (this.damage) stage.append(make('p', {class: 'note'}, this.damage));
    if (panels.length === 0) {
      stage.append(make('p', {class: 'note'}, this.replay
          ? 'This browser draws no WebGL, and the drive was not filmed.'
          : 'No replay or film of this drive can be shown here; the command below films it.'));
    } else {
      first();
      if (panels.length > 1) stage.prepend(tabs);
    }
    this.element.append(stage);
    if (clock.end_s > 0) this.element.append(this.transport());
    if (drive.events.length > 0) this.element.append(this.eventList());
    if (drive.command)
      this.element.append(make('p', {class: 'command'}, make('code', {}, drive.command), ' ',
                               copyButton(drive.command, 'copy')));
    const canvas = stage.querySelector('canvas');
    if (canvas) {
      this.view = new ReplayView(canvas, this.replay, drive.plan || this.replay.plan, drive.events);
      clock.onTime(t_s => this.view.show(t_s));
    }
    this.addPlots();
  }

  addPlots() {
    const columns = this.drive.trace || (this.replay ? columnsOfReplay(this.replay) : null);
    if (!columns || columns.t_s.length < 2 || typeof echarts === 'undefined') return;
    const room = make('div', {class: 'curves', role: 'img',
                              'aria-label': 'Curves over the time of the drive; click to go to a time'});
    this.curves.append(make('div', {class: 'row'}, make('h3', {}, 'Over time'),
        csvButton('curves.csv', () => {
          const names = Object.keys(columns);
          return [names, ...columns.t_s.map((t, i) => names.map(name => columns[name][i]))];
        })), room);
    addTimePlots(room, columns, [
      {key: 'speed_mps', name: 'speed', unit: 'm/s'}, {key: 'tilt_deg', name: 'tilt', unit: '°'},
      {key: 'cross_track_mm', name: 'off the path', unit: 'mm'}, {key: 'power_w', name: 'power', unit: 'W'},
      {key: 'coverage_percent', name: 'covered', unit: '%'}, ...this.safetyCurve(),
    ], this.drive.events, this.clock);
  }

  // Of a supervised drive: the mission's safety state, and the level that it means.
  safetyCurve() {
    const {safety} = this.drive;
    if (!safety) return [];
    const points = safety.t_s.map((t, i) => [t, safety.state[i], safety.level[i]]);
    points.push([this.clock.end_s, ...points[points.length - 1].slice(1)]);
    return [{key: 'safety', name: 'safety state R (0 is safest)', points, says: ([, , level]) => `, level ${level}`}];
  }

  viewButtons() {
    const follow = make('button', {type: 'button', class: 'small', 'aria-pressed': 'true'}, 'follow');
    follow.addEventListener('click', () => {
      this.view.follow = !this.view.follow;
      follow.setAttribute('aria-pressed', String(this.view.follow));
    });
    const look = distance => () => {
      this.view.follow = true;
      follow.setAttribute('aria-pressed', 'true');
      this.view.look(distance);
    };
    return make('div', {class: 'looks'},
                make('button', {type: 'button', class: 'small', onclick: look(1.1)}, 'close'),
                make('button', {type: 'button', class: 'small', onclick: look(2.8)}, 'wide'),
                make('button', {type: 'button', class: 'small', onclick: () => {
                  this.view.follow = false;
                  follow.setAttribute('aria-pressed', 'false');
                  this.view.lookFromAbove();
                }}, 'above'),
                follow);
  }

  transport() {
    const {clock, drive} = this;
    const play = make('button', {type: 'button', class: 'play'}, 'Play');
    play.addEventListener('click', () => (clock.playing ? clock.pause() : clock.play()));
    const slider = make('input', {type: 'range', min: 0, max: clock.end_s, step: 0.02, value: 0,
                                  'aria-label': 'Time of the drive, in seconds'});
    slider.addEventListener('input', () => clock.set(Number(slider.value)));
    const time = make('output', {class: 'time'});
    const speed = make('select', {'aria-label': 'Speed'},
                       ...kSpeeds.map(s => make('option', {value: s, selected: s === 1}, `× ${s}`)));
    speed.addEventListener('change', () => clock.setSpeed(Number(speed.value)));
    clock.onTime(t_s => {
      speed.value = String(clock.speed);
      slider.value = t_s;
      slider.setAttribute('aria-valuetext', clockText(t_s));
      time.textContent = `${clockText(t_s)} of ${clockText(clock.end_s)}`;
      play.textContent = clock.playing ? 'Pause' : 'Play';
    });
    const ticks = make('div', {class: 'ticks', 'aria-hidden': 'true'},
        ...drive.events.map(({t_s}) => {
          const tick = make('i');
          tick.style.left = `${100 * t_s / clock.end_s}%`;
          return tick;
        }));
    return make('div', {class: 'transport'}, play,
                make('div', {class: 'slider'}, slider, ticks), time, speed);
  }

  eventList() {
    return make('ol', {class: 'events'}, ...this.drive.events.map(event => make('li', {},
        make('button', {type: 'button', class: 'link', onclick: () => this.toEvent(event)},
             `${event.what} at ${clockText(event.t_s)}`),
        event.text ? `: ${event.text}` : '')));
  }
  // Some seconds before, so that it is seen to come.
  toEvent(event) {
    this.clock.pause();
    if (this.view) {
      this.view.follow = true;
      this.clock.set(event.t_s - 3);
      this.view.look(1.3);
    } else {
      this.clock.set(event.t_s - 3);
    }
    this.clock.setSpeed(1);
    this.clock.play();
  }

  onKey(event) {
    const step = {ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10}[event.key];
    if (step !== undefined) this.clock.set(this.clock.time_s + step);
    else if (event.key === ' ') this.clock.playing ? this.clock.pause() : this.clock.play();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  tell(t_s) {
    const {replay, drive} = this;
    if (replay) {
      const joint = baseJointOf(replay);
      const [index] = stateAt(replay.t_s, t_s);
      if (joint) this.onTime([0, 1].map(k => replay.states[index * replay.width + joint.first + k]), drive);
    }
  }
}
