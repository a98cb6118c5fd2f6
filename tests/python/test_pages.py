# SPDX-License-Identifier: Apache-2.0
"""Pages as people use them: in Chromium, without a screen and from disk.

A run and a small campaign are driven, and their pages opened at three sizes, in light and dark. A
page fails where it logs an error, asks any network, is wider than its window, or does not do what its
buttons say. Skipped where there is no Chromium; the packages are in pyproject.toml's `test`.
"""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import pytest

sync_api = pytest.importorskip("playwright.sync_api")
axe = pytest.importorskip("axe_playwright_python.sync_playwright")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
if CHROMIUM is None:
    pytest.skip("no browser: install chromium", allow_module_level=True)

TREE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = TREE / "build/release/bin/floorproof"
if not PROGRAM.exists():
    pytest.skip("no build/release/bin/floorproof: ./floorproof builds it", allow_module_level=True)

SIZES = ((390, "dark"), (820, "light"), (1440, "dark"))  # a phone, a tablet, a desk
# Its name must do nothing. A sill about as high as the robot climbs, between start and goal.
SCENARIO = """
scenario: 1
name: '<script>document.title="taken"</script> =1+1'
seed: 1
site:
  site: 1
  name: '=corridor <b>'
  grid:
    cell_m: 0.5
    rows: |
      ########
      #......#
      #......#
      ########
  start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}
  goal: {x_m: 3.0, y_m: 1.0}
  hazards:
    - {type: step, id: '=sill <i>', polygon_m: [[1.8, 0.5], [2.2, 0.5], [2.2, 1.5], [1.8, 1.5]], height_m: 0.017, known: false}
robot: beluga
plan: {planner: straight, speed_mps: 0.3}
success: {min_coverage: 0}
randomise:
  site.hazards.0.height_m: {uniform: [0.008, 0.026]}
  site.floor.friction: {normal: [0.7, 0.08], min: 0.2}
  plan.speed_mps: {uniform: [0.2, 0.3]}
"""
# A motor with a loose contact, which is noticed.
SUPERVISED = """
scenario: 1
site: TREE/models/sites/small_room.yaml
robot: beluga
plan: {planner: boustrophedon}
estimator: mcl
on_failure: ignore
time_limit_s: 40
faults: [{type: weak_motor, wheel: wheel_left, onset_s: 10, period_s: 20, duty: 0.2}]
safety: {react: true}
"""
# What a search for rare failures says, whose likeliest failure was driven and filmed.
RARE = {
    "rare": 1, "name": "sill", "mode": "stuck", "answer": "estimate", "why": "",
    "probability": 1e-4, "lower": 9e-5, "upper": 1.1e-4, "trials": 9000, "clean_drives_needed": 29956,
    "without_sampler": {"lower": 8e-5, "upper": 2e-3, "nominal_draws": 1500, "nominal_failures": 0},
    "coordinates": ["site.floor.friction"], "noise": False, "errors": 0, "gate": None,
    "diagnostics": {"fresh_draws": 2000, "fresh_failures": 300, "effective_failures": 200, "largest_share": 0.02},
    "pilots": [{"end": "failures", "levels": 4, "failures": 100, "probability": 1e-4}],
    "regions": [{"share": 1.0, "draws": 300, "pilots": 1, "distance": 3.7, "likeliest": {
        "set": [], "command": "floorproof run s.yaml", "outcome": "failure",
        "events": [{"mode": "stuck", "hazard": "=sill <i>", "t_s": 10.8}]}}],
}


def floorproof(*arguments, statuses=(0, 1)):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode in statuses, done.stderr


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="floorproof_pages_"))
        cls.run_folder, cls.campaign_folder = cls.folder / "run", cls.folder / "campaign"
        floorproof("run", TREE / "models/scenarios/demo_unseen_step.yaml", "--out", cls.run_folder)
        floorproof("report", cls.run_folder)
        cls.supervised_folder = cls.folder / "supervised"
        supervised = cls.folder / "supervised.yaml"
        supervised.write_text(SUPERVISED.replace("TREE", str(TREE)), encoding="utf-8")
        floorproof("run", supervised, "--out", cls.supervised_folder)
        scenario = cls.folder / "scenario.yaml"
        scenario.write_text(SCENARIO, encoding="utf-8")
        floorproof("campaign", scenario, "-n", 40, "--no-films", "--out", cls.campaign_folder)
        floorproof("report", cls.campaign_folder)
        cls.film_folder = cls.folder / "film"
        floorproof("run", scenario, "--set", "site.hazards.0.height_m=0.03", "--video", "--out", cls.film_folder)
        cls.playwright = sync_api.sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                  "--enable-unsafe-swiftshader"])

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()
        shutil.rmtree(cls.folder)

    def open(self, folder, width=1440, browser=None, name="report.html", **options):
        """The page, which fails the test for whatever it logs or asks for."""
        page = (browser or self.browser).new_page(viewport={"width": width, "height": 900}, **options)
        self.addCleanup(page.close)
        page.on("console", lambda m: self.faults.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda e: self.faults.append(str(e)))
        page.on("request", lambda r: None if r.url.startswith(("file:", "data:", "blob:"))
                else self.faults.append(r.url))
        page.goto((folder / name).as_uri(), wait_until="load")
        page.wait_for_selector("html.alive", state="attached", timeout=20000)
        return page

    def setUp(self):
        self.faults = []

    def tearDown(self):
        self.assertEqual(self.faults, [])

    def test_pages_open_at_every_size_in_light_and_dark(self):
        for folder in (self.run_folder, self.campaign_folder):
            for width, scheme in SIZES:
                with self.subTest(folder=folder.name, width=width, scheme=scheme):
                    page = self.open(folder, width, color_scheme=scheme)
                    self.assertTrue(page.locator(".verdict p").first.is_visible())
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
                    page.close()

    def test_the_verdict_says_what_failed(self):
        page = self.open(self.run_folder)
        text = page.locator(".verdict").inner_text()
        self.assertIn("stuck", text)
        self.assertIn("'plank' (step, 40 mm)", text)
        self.assertIn("beluga, boustrophedon plan,", text)
        self.assertIn("failed", page.locator(".verdict").get_attribute("class"))

    def time_of(self, page):
        return float(page.locator(".time").inner_text().split(" s")[0])

    def test_the_replay_is_scrubbed_and_plays(self):
        page = self.open(self.run_folder)
        picture = lambda: page.evaluate("document.querySelector('canvas').toDataURL()")  # noqa: E731
        at_failure = picture()
        slider = page.locator(".slider input")
        slider.fill("20")
        self.assertAlmostEqual(self.time_of(page), 20, delta=0.1)
        self.assertNotEqual(picture(), at_failure, "another time is another picture")
        page.locator(".play").click()
        page.wait_for_timeout(1200)
        page.locator(".play").click()
        self.assertGreater(self.time_of(page), 20.3)
        page.locator("canvas").first.focus()
        before = self.time_of(page)
        page.keyboard.press("ArrowLeft")
        self.assertAlmostEqual(self.time_of(page), before - 1, delta=0.2)

    def test_it_plays_at_its_speed_however_often_it_is_started(self):
        page = self.open(self.run_folder)
        page.locator(".slider input").fill("20")
        for _ in range(7):
            page.locator(".play").click()
        before, clock = self.time_of(page), page.evaluate("performance.now()")
        page.wait_for_timeout(2000)
        went = self.time_of(page) - before
        passed = (page.evaluate("performance.now()") - clock) / 1000
        self.assertLess(went, 1.3 * passed)
        self.assertGreater(went, 0.3)

    def test_a_damaged_replay_is_said_and_the_rest_is_there(self):
        whole = (self.run_folder / "replay.bin").read_bytes()
        for name, damaged in (("cut", whole[:len(whole) * 2 // 3]), ("garbage", b"x" * 500),
                              ("longer", whole + b"x")):
            with self.subTest(name):
                folder = self.folder / name
                shutil.copytree(self.run_folder, folder)
                (folder / "replay.bin").write_bytes(damaged)
                floorproof("report", folder)
                page = self.open(folder)
                self.assertIn("damaged", page.locator(".stage").inner_text())
                self.assertEqual(page.locator("canvas").count(), 0)
                self.assertTrue(page.locator(".curves").is_visible())
                page.locator(".events button").first.click()
                self.assertGreater(self.time_of(page), 190)
                page.close()

    def test_a_film_keeps_the_time_and_its_own_button_does_too(self):
        browser = self.playwright.chromium.launch(executable_path=CHROMIUM,
                                                  args=["--no-sandbox", "--disable-3d-apis"])
        self.addCleanup(browser.close)
        for gl in (True, False):
            with self.subTest(webgl=gl):
                page = self.open(self.film_folder, browser=None if gl else browser)
                self.assertEqual(page.locator("canvas").count(), 1 if gl else 0)
                if gl:
                    page.locator("#tab-film").click()
                film = "document.querySelector('video')"
                page.locator(".slider input").fill("3")
                before = page.evaluate(f"{film}.currentTime")
                page.evaluate(f"{film}.play()")  # as its own button does
                page.wait_for_timeout(1500)
                page.evaluate(f"{film}.pause()")
                page.wait_for_timeout(200)
                self.assertGreater(page.evaluate(f"{film}.currentTime"), before + 0.3)
                self.assertGreater(self.time_of(page), 3.3)
                self.assertEqual(page.locator(".play").inner_text(), "Play")
                page.locator(".play").click()
                page.wait_for_timeout(700)
                self.assertFalse(page.evaluate(f"{film}.paused"))
                page.locator(".events button").first.click()
                page.wait_for_timeout(300)
                self.assertGreater(self.time_of(page), 5)
                self.assertGreater(page.evaluate(f"{film}.currentTime"), before + 1)
                page.close()

    def test_a_rare_failure_is_replayed(self):
        folder = self.folder / "rare"
        shutil.copytree(self.film_folder, folder / "likeliest/1")
        (folder / "rare.json").write_text(json.dumps(RARE), encoding="utf-8")
        floorproof("report", folder)
        page = self.open(folder, name="rare.html")
        self.assertIn("1 in 10,000 drives", page.locator(".verdict").inner_text())
        self.assertEqual(page.locator("canvas").count(), 1)
        page.locator("#tab-film").click()
        self.assertTrue(page.locator("video").is_visible())
        self.assertTrue(page.locator("#map-view svg").first.is_visible())
        found = axe.Axe().run(page).response["violations"]
        self.assertEqual([(v["id"], v["nodes"][0]["html"][:200]) for v in found], [])

    def test_two_variants_are_compared_on_a_page(self):
        scenario = self.folder / "two.yaml"
        scenario.write_text(SCENARIO.replace("  plan.speed_mps: {uniform: [0.2, 0.3]}\n", "")
                            + "matrix: {plan.speed_mps: [0.2, 0.3]}\n", encoding="utf-8")
        folder = self.folder / "two"
        floorproof("campaign", scenario, "-n", 12, "--no-films", "--out", folder)
        floorproof("compare", f"{folder}:speed_mps=0.2", f"{folder}:speed_mps=0.3", "--page",
                   folder / "report.html")
        page = self.browser.new_page()  # no scripts
        self.addCleanup(page.close)
        page.goto((folder / "report.html").as_uri())
        self.assertIn("speed_mps=0.3", page.locator("h1").inner_text())
        self.assertIn("12 drives", page.locator(".verdict").inner_text())
        for section in ("#pairs", "#modes", "#metrics", "#plans"):  # what the command says, all of it
            self.assertTrue(page.locator(f"{section} table").is_visible(), section)
        self.assertIn("McNemar", page.locator("#modes").inner_text())
        self.assertIn("length_m", page.locator("#plans").inner_text())
        floorproof("compare", f"{folder}:speed_mps=0.2", f"{folder}:speed_mps=0.3", "--page",
                   folder / "report.txt", statuses=(2,))

    def test_an_event_leads_to_the_moments_before_it(self):
        page = self.open(self.run_folder)
        page.locator(".slider input").fill("10")
        page.locator(".events button").first.click()
        self.assertGreater(self.time_of(page), 190)

    def test_a_click_into_the_curves_goes_to_that_time(self):
        page = self.open(self.run_folder)
        page.locator(".curves").scroll_into_view_if_needed()
        box = page.locator(".curves").bounding_box()
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + 50)
        self.assertAlmostEqual(self.time_of(page), 99, delta=15)

    def test_visits_coverage_and_rates_lie_over_the_floor_with_a_legend(self):
        for folder, layers in ((self.run_folder, ("visits", "coverage")), (self.campaign_folder, ("failure rate",))):
            page = self.open(folder)
            drawn = lambda: page.locator("#map-view svg").first.inner_html()  # noqa: E731
            bare = drawn()
            seen = {bare}
            for layer in layers:
                page.locator(".layers button", has_text=layer).click()
                page.wait_for_timeout(200)
                self.assertTrue(page.locator(".layer-legend > *").is_visible())
                seen.add(drawn())
            self.assertEqual(len(seen), len(layers) + 1, "each is another picture")
            page.locator(".layers button", has_text="floor").click()
            page.wait_for_timeout(200)
            self.assertEqual(page.locator(".layer-legend > *").count(), 0)

    def test_a_supervised_drive_has_the_curve_of_its_safety(self):
        page = self.open(self.supervised_folder)
        self.assertIn("safety state", page.locator(".curves").inner_text())
        self.assertNotIn("safety state", self.open(self.run_folder).locator(".curves").inner_text())

    def test_a_marker_on_the_map_leads_to_its_drive_and_its_row(self):
        page = self.open(self.campaign_folder)
        data = json.loads(page.locator("#page-data").text_content())
        failures = data["maps"][0]["failures"]
        self.assertGreater(len(failures), 5)
        page.locator("#map-view svg path[fill='#b83a2f']").last.click(force=True)  # the first is the legend's
        # All of them are on one spot: a list says so.
        names = page.locator(".pile button")
        self.assertGreater(names.count(), 5)
        names.nth(3).click()
        chosen = page.locator("#which-drive option:checked").inner_text()
        self.assertIn(names.nth(3).inner_text().split(":")[0], chosen)
        selected = page.locator(".ag-row-selected [col-id='episode']").first.inner_text()
        self.assertIn(f"episode {selected}:", chosen)
        # The same by keys alone.
        page.locator("#map-view button", has_text="list the").focus()
        page.keyboard.press("Enter")
        self.assertEqual(page.locator(".pile button").count(), len(failures))
        page.locator(".pile button").nth(1).focus()
        page.keyboard.press("Enter")
        self.assertIn(page.locator(".pile button").nth(1).inner_text().split(":")[0],
                      page.locator("#which-drive option:checked").inner_text())

    def test_the_table_sorts_filters_and_shows(self):
        page = self.open(self.campaign_folder)
        first = lambda key: page.locator(f".ag-row[row-index='0'] [col-id='{key}']").inner_text()  # noqa: E731
        self.assertNotIn("<", first("what"))
        page.locator(".ag-header-cell[col-id='episode'] .ag-header-cell-label").click()
        lowest = int(first("episode"))
        page.locator(".ag-header-cell[col-id='episode'] .ag-header-cell-label").click()
        self.assertGreater(int(first("episode")), lowest)
        page.locator(".ag-floating-filter input").first.fill(str(lowest))
        page.wait_for_timeout(900)
        self.assertEqual(int(first("episode")), lowest)
        page.locator(".ag-row[row-index='0'] .actions button", has_text="show").click()
        label = page.locator("#which-drive option:checked").inner_text()
        self.assertIn(str(lowest), label)

    def test_a_download_is_harmless_in_a_spreadsheet(self):
        page = self.open(self.campaign_folder)
        with page.expect_download() as download:
            page.locator("#episode-table button", has_text="CSV").click()
        rows = pathlib.Path(download.value.path()).read_text(encoding="utf-8").splitlines()
        self.assertGreater(len(rows), 5)
        for row in rows[1:]:
            self.assertFalse(any(cell.startswith(("=", "@")) for cell in row.split(",")), row)

    def test_each_table_is_saved_as_it_is_read(self):
        page = self.open(self.campaign_folder)
        with page.expect_download() as download:
            page.locator("#rates .saves button").first.click()
        rows = pathlib.Path(download.value.path()).read_text(encoding="utf-8").splitlines()
        self.assertEqual(rows[0], "Failure,Episodes,Rate,95 % interval")
        shown = page.locator("#rates table").first.locator("tbody tr").first.locator("td").first.inner_text()
        self.assertEqual(rows[1].split(",")[:2], ["any failure", shown])

    def test_a_name_that_is_a_script_does_nothing(self):
        page = self.open(self.campaign_folder)
        self.assertNotEqual(page.title(), "taken")
        self.assertIn("<script>", page.locator("h1").inner_text())

    def test_without_scripts_the_page_is_whole(self):
        context = self.browser.new_context(java_script_enabled=False)
        self.addCleanup(context.close)
        page = context.new_page()
        page.goto((self.campaign_folder / "report.html").as_uri())
        self.assertTrue(page.locator("table.list tbody tr").first.is_visible())
        self.assertTrue(page.locator(".replaced-by-map img").first.is_visible())

    def test_it_prints_in_light_and_says_what_failed(self):
        page = self.open(self.run_folder, color_scheme="dark")
        pdf = page.pdf(format="A4")
        self.assertGreater(len(pdf), 20000)
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        page.emulate_media(media="print", color_scheme="dark")
        self.assertIn("stuck at", page.locator(".events").inner_text())
        self.assertFalse(page.locator("#map-view").is_visible(), "the picture is printed instead")
        self.assertEqual(page.evaluate("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)")
        self.assertEqual(page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--ink')").strip(),
                         "#000")

    def test_whoever_cannot_see_or_point_can_use_it(self):
        for folder in (self.run_folder, self.campaign_folder):
            for scheme in ("light", "dark"):
                with self.subTest(folder=folder.name, scheme=scheme):
                    page = self.open(folder, color_scheme=scheme)
                    found = axe.Axe().run(page).response["violations"]
                    self.assertEqual([(v["id"], v["nodes"][0]["html"][:200]) for v in found], [])
                    page.close()
