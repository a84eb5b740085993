// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "figures.hpp"
#include "options.hpp"

#include <cstdio>

using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures how long solvers, estimation, maps and the whole correction take, and prints a line\n"
    "name<TAB>value<TAB>unit for each figure. Ratios are to functions of OpenCV in the same run.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{filter     |        | only the figures whose names contain this}"
    "{rounds     | 11     | how often everything is measured}"
    "{threads    |        | number of threads if it isn't one (default: as many as there are processors)}";

int run(const Options& options)
{
    options.refuseArguments();
    benchmark::Benchmark all;
    benchmark::addSolverFigures(all);
    benchmark::addEstimateFigures(all);
    benchmark::addMapFigures(all);
    benchmark::addCorrectFigures(all);
    benchmark::addFolderFigures(all);
    all.run(options.given("filter") ? options.text("filter") : "", options.integer("rounds", 1, 10000),
            options.given("threads") ? options.integer("threads", 1, 1024) : cv::getNumberOfCPUs());
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
