// SPDX-License-Identifier: Apache-2.0
// Which windows are known, and where colours are shown: on a pseudo-terminal.
#include "base/terminal.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <map>
#include <string>

#include "base/console.h"

namespace floorproof {
namespace {

class Terminal : public testing::Test {
 protected:
  Terminal() {
    for (const char* name : kNames)
      if (const char* value = std::getenv(name)) before_[name] = value;
    for (const char* name : kNames) unsetenv(name);
    setenv("TERM", "xterm", 1);
    EXPECT_EQ(openpty(&shown_, &fd_, nullptr, nullptr, nullptr), 0);
    EXPECT_EQ(pipe(pipe_.data()), 0);
  }
  ~Terminal() override {
    for (const int fd : {shown_, fd_, pipe_[0], pipe_[1]}) close(fd);
    for (const char* name : kNames) unsetenv(name);
    for (const auto& [name, value] : before_) setenv(name.c_str(), value.c_str(), 1);
  }
  void SetWindow(int columns) const {
    winsize window{};
    window.ws_col = static_cast<unsigned short>(columns);
    ASSERT_EQ(ioctl(fd_, TIOCSWINSZ, &window), 0);
  }

  int shown_ = -1, fd_ = -1;
  std::array<int, 2> pipe_{};

 private:
  static constexpr const char* kNames[] = {"TERM", "COLUMNS", "NO_COLOR"};
  std::map<std::string, std::string> before_;
};

TEST_F(Terminal, IsAsWideAsItsWindow) {
  setenv("COLUMNS", "100", 1);
  for (const int columns : {40, 80, 200}) {
    SetWindow(columns);
    EXPECT_EQ(TerminalWidth(fd_), columns);
  }
}

TEST_F(Terminal, IsAsWideAsTheShellSaysWhereItDoesNotKnow) {
  SetWindow(0);
  EXPECT_EQ(TerminalWidth(fd_), 80);
  for (const auto& [text, width] : {std::pair("100", 100), {"wide", 80}, {"-5", 80}, {"", 80}}) {
    setenv("COLUMNS", text, 1);
    EXPECT_EQ(TerminalWidth(fd_), width) << text;
  }
  EXPECT_EQ(TerminalWidth(pipe_[1]), 80) << "of a pipe no width is asked for";
}

TEST_F(Terminal, ShowsColoursUnlessTheyAreUnwanted) {
  EXPECT_TRUE(HasColours(fd_));
  EXPECT_FALSE(HasColours(pipe_[1]));
  setenv("NO_COLOR", "", 1);
  EXPECT_TRUE(HasColours(fd_)) << "empty is as if it were not set";
  setenv("NO_COLOR", "0", 1);
  EXPECT_FALSE(HasColours(fd_)) << "whatever it says";
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(HasColours(fd_));
  EXPECT_FALSE(IsTerminal(fd_));
}

TEST_F(Terminal, WhoListensGetsPlainLinesOfEightyColumns) {
  FactTable table;
  table.Add({"Verdict", {std::string(40, 'a') + " " + std::string(30, 'b'), Tone::kBad}});
  std::string said;
  Console{.listener = [&](const std::string& line) { said += line + "|"; }}.Say(table);
  const std::string name = "  Verdict             ", room(name.size(), ' ');
  EXPECT_EQ(said, name + std::string(40, 'a') + "|" + room + std::string(30, 'b') + "|");
}

// A name of two lines must not pass for a verdict.
TEST_F(Terminal, WhatIsSaidIsOneLine) {
  std::string said;
  const Console dut{.listener = [&](const std::string& line) { said += line + "|"; }};
  dut.Say("hazard x\nPASSED\tall\x1b[2J");
  EXPECT_EQ(said, "hazard x PASSED all?[2J|");
}

}  // namespace
}  // namespace floorproof
