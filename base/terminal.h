// SPDX-License-Identifier: Apache-2.0
// What the terminal at a file descriptor can show, where there is one.
#pragma once

namespace floorproof {

// A terminal that can move its cursor: TERM is set and not "dumb".
bool IsTerminal(int fd);
// In columns: the window's; where the terminal does not know it, COLUMNS; in a pipe, and where
// neither says, 80.
int TerminalWidth(int fd);
// Of a terminal, unless NO_COLOR is set and not empty (https://no-color.org).
bool HasColours(int fd);

}  // namespace floorproof
