// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "options.hpp"
#include "study.hpp"

#include "opencv2/core/utility.hpp"
#include "opencv2/core/utils/filesystem.hpp"
#include <cstdio>

using namespace paper;
using namespace rsackermann_samples;

namespace {

const char* const ABOUT =
    "Measures what the paper reports, and more, by the paper's method and by the library. Writes a table for each\n"
    "study, which is skipped if its table is there already.\n"
    "usage: rsackermann_reproduce_paper STUDY... --output=FOLDER [--option=value]...\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{output     |        | folder for the tables}"
    "{photos     |        | for the study photos: folder with a frames.csv of street photographs, of frames with "
    "global-shutter images or of a drive, or folder of such folders}"
    "{quick      |        | a part of the cases}"
    "{seed       | 0      | of streets, noise and samples}"
    "{threads    |        | number of threads}";

struct Study
{
    const char* name;
    void (*make)(const StudyOptions&);
};

const Study STUDIES[] = {{"motion", studyMotion},       {"patches", studyPatches}, {"gravity", studyGravity},
                         {"distances", studyDistances}, {"time", studyTime},       {"solver_time", studySolverTime},
                         {"solvers", studySolvers},     {"bound", studyBound},     {"conditions", studyConditions},
                         {"photos", studyPhotos}};

const Study& findStudy(const std::string& name)
{
    std::string names;
    for (const Study& study : STUDIES)
    {
        if (name == study.name)
            return study;
        names += std::string(" ") + study.name;
    }
    throw UsageError("unknown study " + name + "; there are" + names);
}

int run(const Options& options)
{
    if (options.arguments().empty() || !options.given("output"))
        throw UsageError("STUDY and --output=FOLDER are expected");
    if (options.given("threads"))
        cv::setNumThreads(options.integer("threads", 1, 1024));
    const StudyOptions study = {options.text("output"), options.given("photos") ? options.text("photos") : "",
                                options.flag("quick"), options.integer("seed", 0, 1 << 20)};
    for (const std::string& name : options.arguments())
        findStudy(name);
    for (const std::string& name : options.arguments())
    {
        if (cv::utils::fs::exists(study.folder + "/" + name + ".csv"))
        {
            std::fprintf(stderr, "%s: there already\n", name.c_str());
            continue;
        }
        findStudy(name).make(study);
    }
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
