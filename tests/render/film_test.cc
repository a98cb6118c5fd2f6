// SPDX-License-Identifier: Apache-2.0
#include "render/film.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdio>

#include "base/input_file.h"
#include "env/core/event_evidence.h"
#include "tests/render/room.h"

namespace floorproof {
namespace {

int Between(const std::vector<FilmFrame>& frames, double low_s, double high_s) {
  return static_cast<int>(std::count_if(frames.begin(), frames.end(), [&](const FilmFrame& f) {
    return f.t_s >= low_s && f.t_s < high_s;
  }));
}

TEST(FilmScheduleTest, ShortEpisodeRunsInRealTime) {
  const auto dut = ScheduleFilm(0, 4, {}, {});
  EXPECT_EQ(Between(dut, 0, 4), 4 * 30);
  EXPECT_EQ(dut.front().t_s, 0);
  EXPECT_EQ(dut.front().speed_up, 1);
  EXPECT_EQ(std::count_if(dut.begin(), dut.end(), [](auto& f) { return f.t_s == 4; }), 1 + 45);
}

TEST(FilmScheduleTest, LengthIsBoundedAndTimeNeverRunsBack) {
  const std::array<double, 3> events = {55, 57, 300};
  for (const double duration : {0.0, 0.01, 7.0, 60.0, 613.0, 1e4, 1e6}) {
    for (const int max_frames : {2, 10, 100, 600}) {
      FilmPace pace;
      pace.max_frames = max_frames;
      const auto dut = ScheduleFilm(10, 10 + duration, events, pace);
      ASSERT_FALSE(dut.empty());
      EXPECT_LE(static_cast<int>(dut.size()), max_frames);
      EXPECT_EQ(dut.back().t_s, 10 + duration);
      for (std::size_t i = 1; i < dut.size(); ++i) EXPECT_GE(dut[i].t_s, dut[i - 1].t_s);
    }
  }
}

// Seconds before a failure take as many seconds of film; the way there is a time lapse.
TEST(FilmScheduleTest, FailureIsShownInRealTime) {
  const std::array<double, 1> events = {250};
  const auto dut = ScheduleFilm(0, 250, events, {});
  EXPECT_NEAR(Between(dut, 246, 250), 4 * 30, 1);
  for (const FilmFrame& f : dut) {
    if (f.t_s < 245.9) {
      EXPECT_GE(f.speed_up, 10);
    }
    if (f.t_s > 246) {
      EXPECT_EQ(f.speed_up, 1);
    }
  }
}

TEST(FilmScheduleTest, AskedSpeedIsKeptWhereItFits) {
  FilmPace pace;
  pace.speed_up = 20;
  EXPECT_EQ(ScheduleFilm(0, 100, {}, pace).front().speed_up, 20);
  pace.speed_up = 2;
  EXPECT_GT(ScheduleFilm(0, 1000, {}, pace).front().speed_up, 50);
}

TEST(FilmScheduleTest, PassagesLieAroundTheirEvents) {
  FilmPace pace;
  pace.before_s = 6;
  pace.after_s = 2;
  const double events_s[] = {2, 50, 53, 99.5, 100.02};
  const auto dut = PassagesAround(0, 100, events_s, pace);
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_EQ(std::pair(dut[0].begin_s, dut[0].end_s), std::pair(0.0, 4.0));
  EXPECT_EQ(std::pair(dut[1].begin_s, dut[1].end_s), std::pair(44.0, 55.0));
  EXPECT_EQ(std::pair(dut[2].begin_s, dut[2].end_s), std::pair(93.5, 100.0));
}

TEST(FilmScheduleTest, OfPassagesNothingElseIsShown) {
  FilmPace pace;
  pace.fps = 15;
  const FilmPassage passages[] = {{1, 4}, {10, 18}};
  for (const int max_frames : {600, 60}) {
    pace.max_frames = max_frames;
    const auto dut = SchedulePassages(passages, pace);
    EXPECT_LE(static_cast<int>(dut.size()), max_frames + 2);
    EXPECT_EQ(dut.front().t_s, 1);
    EXPECT_EQ(dut.back().t_s, 18);
    int jumps = 0;
    for (std::size_t i = 0; i < dut.size(); ++i) {
      EXPECT_TRUE((dut[i].t_s >= 1 && dut[i].t_s <= 4) || (dut[i].t_s >= 10 && dut[i].t_s <= 18));
      if (i == 0) continue;
      const double step_s = dut[i].t_s - dut[i - 1].t_s;
      EXPECT_GE(step_s, 0);
      jumps += step_s > dut[i].speed_up / 15 + 1e-9;
    }
    EXPECT_EQ(jumps, 1);
    EXPECT_EQ(dut.front().speed_up == 1, max_frames == 600) << "in real time where it fits";
  }
}

TEST(FilmScheduleTest, ManyEventsLeaveHalfOfTheFilmToTheRest) {
  std::vector<double> events;
  for (int i = 0; i < 50; ++i) events.push_back(20.0 * i);
  const auto dut = ScheduleFilm(0, 1000, events, {});
  const auto slow = std::count_if(dut.begin(), dut.end(), [](auto& f) { return f.speed_up == 1; });
  EXPECT_GT(slow, 100);
  EXPECT_LE(slow, 300 + 1);
  EXPECT_LE(dut.size(), 600u);
}

struct Probe {
  std::string codec, format;
  int width = 0, height = 0, frames = 0;
};
// What ffprobe says of a film; no codec where there is no ffprobe.
Probe ProbeFilm(const std::filesystem::path& path) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v:0 -of default=nw=1:nk=1 -show_entries "
      "stream=codec_name,width,height,pix_fmt,nb_read_frames '" +
      path.string() + "' 2>/dev/null";
  Probe probe;
  FILE* pipe = popen(command.c_str(), "r");
  char codec[64] = "", format[64] = "";
  if (std::fscanf(pipe, "%63s %d %d %63s %d", codec, &probe.width, &probe.height, format,
                  &probe.frames) == 5) {
    probe.codec = codec;
    probe.format = format;
  }
  pclose(pipe);
  return probe;
}

// The robot drives 2 m to the step, climbs and tips over.
Recording Drive(Room& room) {
  Recording recording(static_cast<int>(room.model()->nq));
  for (int i = 0; i <= 50 * 12; ++i) {
    const double t = i / 50.0;
    const double fall = std::clamp((t - 10) / 1.5, 0.0, 1.0);
    const Pose2 X_WB{-1.4 + 0.2 * std::min(t, 11.0), -0.5, 0};
    room.Put(X_WB, 0.04 * fall, -1.3 * fall * fall);
    recording.Add(t, room.data()->qpos, {X_WB.x_m, X_WB.y_m, 0.04 * fall}, 0.3, t / 40);
  }
  return recording;
}

class FilmTest : public ::testing::Test {
 protected:
  void Open() {
    room_ = std::make_unique<Room>();
    recording_ = std::make_unique<Recording>(Drive(*room_));
    event_.mode = FailureMode::kRollOver;
    event_.t_s = 11.4;
    event_.hazard = "step-0";
    event_.value = 1.25;
    event_.threshold = 1.22;
    script_.model = room_->model();
    script_.base_body = room_->base();
    script_.recording = recording_.get();
    script_.events = {&event_, 1};
    script_.title = "box robot in a room";
    script_.set = room_->Set();
    script_.plan = &plan_;
    options_.width = 320;
    options_.height = 180;
    options_.pace.max_frames = 40;
  }
  TestFolder folder_;
  std::unique_ptr<Room> room_;
  std::unique_ptr<Recording> recording_;
  Event event_;
  Path plan_ = Straight({{-1.4, -0.5}, {2.5, -0.5}, {2.5, -0.2}, {-2, -0.2}});
  FilmScript script_;
  FilmOptions options_;
};

TEST_F(FilmTest, PlaysInABrowser) {
  FP_NEED_GL();
  Open();
  const FilmResult result = WriteFilm(script_, options_, folder_ / "video.mp4");
  EXPECT_LE(result.frames, 40);
  EXPECT_GT(result.frames, 20);
  const Probe probe = ProbeFilm(folder_ / "video.mp4");
  if (probe.codec.empty()) GTEST_SKIP() << "no ffprobe to look at the film with";
  EXPECT_EQ(probe.codec, "h264");
  EXPECT_EQ(probe.format, "yuv420p");
  EXPECT_EQ(probe.width, 320);
  EXPECT_EQ(probe.height, 180);
  EXPECT_EQ(probe.frames, result.frames);
}

// Of a camera that follows with a lag, stripes that grow and a shell that turns to glass: who draws
// only some of the frames must still know all.
TEST_F(FilmTest, AnyNumberOfProcessesDrawsTheSameFilm) {
  FP_NEED_GL();
  Open();
  script_.window_m = 0.8;
  script_.swept_again = {{6, {-1.2, 1}, {0.2, 1}, 0.5, 0}};
  std::string first;
  for (const int processes : {3, 2, 1}) {  // alone the last: then this process draws
    options_.processes = processes;
    const auto file = folder_.path() / fmt::format("{}.mp4", processes);
    WriteFilm(script_, options_, file);
    const std::string film = ReadInputFile(file, 1 << 24);
    if (first.empty()) first = film;
    EXPECT_TRUE(film == first) << processes;
  }
}

TEST_F(FilmTest, StillsShowStartFailureAndEnd) {
  FP_NEED_GL();
  Open();
  options_.stills = folder_.path();
  WriteFilm(script_, options_, folder_ / "video.mp4");
  const Image start = ReadImage(folder_ / "frame_start.png");
  const Image failure = ReadImage(folder_ / "frame_failure.png");
  const Image end = ReadImage(folder_ / "frame_end.png");
  const auto red = [](const Image& image) {  // of the banner
    return Pixel(image, image.width - 4, 2)[0] - Pixel(image, image.width - 4, 2)[1];
  };
  EXPECT_LT(red(start), 60);
  EXPECT_GT(red(failure), 60);
  EXPECT_GT(red(end), 60);
  EXPECT_NE(failure.data, start.data);
}

TEST_F(FilmTest, TheWindowAndWhatIsSweptAgainAreSeen) {
  FP_NEED_GL();
  Open();
  options_.camera = "top";
  options_.stills = folder_.path();
  const auto count = [&](const char* still, const auto& is) {
    const Image image = ReadImage(folder_ / still);
    int n = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) n += is(Pixel(image, x, y));
    return n;
  };
  const auto blue = [](const std::uint8_t* p) { return p[2] > p[0] + 90 && p[2] > p[1] + 60; };
  const auto orange = [](const std::uint8_t* p) { return p[0] > p[2] + 90 && p[1] > p[2] + 40; };
  script_.plan = nullptr;
  WriteFilm(script_, options_, folder_ / "without.mp4");
  const int blue_before = count("frame_start.png", blue),
            orange_before = count("frame_end.png", orange);
  script_.window_m = 0.8;
  script_.swept_again = {{6, {-1.2, 1}, {0.2, 1}, 0.5, 0}};
  WriteFilm(script_, options_, folder_ / "with.mp4");
  EXPECT_GT(count("frame_start.png", blue), blue_before + 60);
  EXPECT_LT(count("frame_start.png", orange), orange_before + 60) << "not yet";
  EXPECT_GT(count("frame_end.png", orange), orange_before + 300);
}

// Events are timed by physics steps, states recorded less often.
TEST_F(FilmTest, EventAfterTheLastStateIsStillShown) {
  FP_NEED_GL();
  Open();
  event_.t_s = 12.004;
  options_.stills = folder_.path();
  WriteFilm(script_, options_, folder_ / "video.mp4");
  const Image end = ReadImage(folder_ / "frame_end.png");
  EXPECT_GT(Pixel(end, end.width - 4, 2)[0], Pixel(end, end.width - 4, 2)[1] + 60);
  EXPECT_EQ(ReadImage(folder_ / "frame_failure.png").data, end.data);
}

TEST_F(FilmTest, WithoutAFailureTheClosingBannerComesLast) {
  FP_NEED_GL();
  Open();
  script_.events = {};
  script_.closing = Banner{Banner::Tone::kSuccess, "SUCCESS", ""};
  options_.stills = folder_.path();
  WriteFilm(script_, options_, folder_ / "video.mp4");
  const Image start = ReadImage(folder_ / "frame_start.png");
  const Image end = ReadImage(folder_ / "frame_end.png");
  const auto green = [](const Image& image) {
    return Pixel(image, image.width - 4, 2)[1] - Pixel(image, image.width - 4, 2)[0];
  };
  EXPECT_LT(green(start), 40);
  EXPECT_GT(green(end), 40);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "frame_failure.png"));
}

// After the event the notice stands, until another event.
TEST_F(FilmTest, ANoticeStandsBetweenEvents) {
  FP_NEED_GL();
  Open();
  const auto last_picture = [&](double notice_s) {
    script_.notices = {{notice_s, {Banner::Tone::kSuccess, "HELPED", ""}}};
    options_.stills = folder_.path();
    WriteFilm(script_, options_, folder_ / "video.mp4");
    const Image end = ReadImage(folder_ / "frame_end.png");
    const std::uint8_t* pixel = Pixel(end, end.width - 4, 2);
    return pixel[1] > pixel[0] ? "green" : "red";
  };
  EXPECT_EQ(last_picture(event_.t_s + 0.3), "green");
  EXPECT_EQ(last_picture(event_.t_s - 0.3), "red");
}

// Of two failures the film is about the first: what came later is not in it, nor in its banner.
TEST_F(FilmTest, OnlyTheSecondsAroundAnEventAreShown) {
  FP_NEED_GL();
  Open();
  std::vector<Event> events(2, event_);
  events[0].mode = FailureMode::kStuck;
  events[0].t_s = 5;
  options_.pace.fps = 5;
  options_.pace.before_s = 2;
  options_.pace.after_s = 1;
  options_.pace.max_frames = 100;
  options_.only_around_s = {5};
  options_.stills = folder_.path();
  int done = 0, all = 0;
  options_.on_frame = [&](int now, int of) {
    EXPECT_EQ(now, done + 1);
    done = now;
    all = of;
  };
  const auto filmed = [&](std::size_t n) {
    done = 0;
    script_.events = {events.data(), n};
    const FilmResult result = WriteFilm(script_, options_, folder_ / "video.mp4");
    EXPECT_EQ(done, result.frames);
    EXPECT_EQ(all, result.frames);
    EXPECT_NEAR(result.frames, 5 * (2 + 1 + options_.pace.hold_s), 2);
    return std::array{ReadImage(folder_ / "frame_start.png").data,
                      ReadImage(folder_ / "frame_failure.png").data,
                      ReadImage(folder_ / "frame_end.png").data};
  };
  const auto both = filmed(2), alone = filmed(1);
  EXPECT_EQ(both, alone);
  EXPECT_NE(both[0], both[1]);
  EXPECT_NE(both[1], both[2]);
  options_.only_around_s = {11.4};
  EXPECT_NE(filmed(2)[1], both[1]);
}

// A robot that stands is found to be stuck seconds later: the film shows how it came to stand.
TEST_F(FilmTest, WhatHeldTheRobotIsShownNotOnlyThatItStands) {
  FP_NEED_GL();
  Open();
  event_.mode = FailureMode::kStuck;
  event_.t_s = 6;
  event_.evidence = {{"still_s", 3}};
  EXPECT_EQ(BeganAt(event_), 3);
  script_.events = {&event_, 1};
  options_.pace.fps = 5;
  options_.pace.before_s = 2;
  options_.pace.after_s = 1;
  options_.pace.max_frames = 100;
  options_.only_around_s = {6};
  const FilmResult result = WriteFilm(script_, options_, folder_ / "video.mp4");
  EXPECT_NEAR(result.frames, 5 * (7 - 1 + options_.pace.hold_s), 2) << "from 1 s to 7 s";
}

// The same scene without shadows.
TEST_F(FilmTest, ADraftShowsTheSameForLess) {
  FP_NEED_GL();
  Open();
  options_.stills = folder_.path();
  const auto start = [&](RenderQuality quality) {
    options_.quality = quality;
    WriteFilm(script_, options_, folder_ / "video.mp4");
    return ReadImage(folder_ / "frame_start.png");
  };
  const Image full = start(RenderQuality::kGood), draft = start(RenderQuality::kDraft);
  ASSERT_EQ(full.data.size(), draft.data.size());
  double apart = 0, darker = 0;
  for (int y = 0; y < full.height; ++y)
    for (int x = 0; x < full.width; ++x) {
      apart += Difference(full, draft, x, y);
      darker += Luma(full, x, y) < Luma(draft, x, y) - 20;
    }
  EXPECT_LT(apart / (full.width * full.height), 12);
  EXPECT_GT(darker, 50) << "shadows";
}

TEST_F(FilmTest, BadOptionsAreRefusedInWords) {
  FP_NEED_GL();
  Open();
  options_.width = 321;
  EXPECT_THROW(WriteFilm(script_, options_, folder_ / "a.mp4"), InputError);
  options_.width = 320;
  options_.camera = "drone";
  EXPECT_THROW(WriteFilm(script_, options_, folder_ / "a.mp4"), InputError);
  options_.camera = "top";
  options_.pace.fps = 0;
  EXPECT_THROW(WriteFilm(script_, options_, folder_ / "a.mp4"), InputError);
  options_.pace.fps = 30;
  EXPECT_THROW(WriteFilm(script_, options_, folder_ / "no" / "such" / "a.mp4"), InputError);
}

}  // namespace
}  // namespace floorproof
