// SPDX-License-Identifier: Apache-2.0
#include "apps/run_floorproof.h"

int main(int argc, char** argv) { return floorproof::RunFloorproof(argc, argv); }
