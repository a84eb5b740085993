// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Undoes the rolling shutter of images and videos that a car's camera has taken.

#include "correct/image_task.hpp"
#include "progress.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "correct/video_task.hpp"
#endif

#include "opencv2/core/utils/filesystem.hpp"
#include <functional>
#include <iostream>
#include <limits>

namespace {

using namespace rsackermann_samples;

const char* const ABOUT =
    "Undoes the rolling shutter of images and videos that a car's camera has taken.\n"
    "usage: rsackermann_correct INPUT... [--option=value]...\n"
    "INPUT is an image, a video, a folder of images, a printf pattern of image names or @FILE with a name a line.\n"
    "Exit code: 0 all is done, 1 some inputs failed, 2 the command line isn't understood.\n";

void complain(const std::string& input, const std::string& message, Progress& progress)
{
    progress.clear();
    std::cerr << "rsackermann_correct: " << input << ": " << message << std::endl;
}

// An existing report is refused before any work is done.
std::unique_ptr<ReportFile> openReport(const Job& job)
{
    if (job.report.empty())
        return nullptr;
    if (job.report != "-" && !job.overwrite && !job.skipExisting && cv::utils::fs::exists(job.report))
        throw InputError(job.report + " exists (--overwrite replaces it)");
    return std::unique_ptr<ReportFile>(new ReportFile(job.report, job.skipExisting));
}

// Corrects a file; the lines for the report are there even if the end of a video isn't.
// The progress within the file is told as a share.
void correctFile(size_t index, const Job& job, FrameCorrector& corrector, std::vector<std::string>& lines,
                 const std::function<void(double)>& progress)
{
    const std::string& input = job.inputs.files[index];
    const Targets targets(job, input);
    targets.check(job, input);
#ifdef RSACKERMANN_WITH_VIDEOIO
    if (isVideo(input))
    {
        correctVideo(input, targets, job.log, corrector, lines, progress);
        return;
    }
#endif
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    lines.push_back(correctImage(input, targets, job.log.of(input, job.inputs.numbers[index], unknown), corrector));
    progress(1);
}

int run(int argc, const char* const* argv)
{
    Options options(argc, argv, std::string(JOB_KEYS) + CAMERA_KEYS);
    if (options.given("help"))
    {
        options.printHelp(ABOUT);
        return 0;
    }
    const Job job = readJob(options);
    const std::unique_ptr<ReportFile> report = openReport(job);
    FrameCorrector corrector(job);
    Progress progress;
    size_t failed = job.inputs.failures.size();
    for (const std::pair<std::string, std::string>& failure : job.inputs.failures)
        complain(failure.first, failure.second, progress);
    double done = 0;
    for (size_t i = 0; i < job.inputs.files.size(); i++)
    {
        const std::string& input = job.inputs.files[i];
        if (job.skipExisting && Targets(job, input).exist())
            continue;
        std::vector<std::string> lines;
        try
        {
            // What is left out takes no time.
            const double total = done + double(job.inputs.files.size() - i);
            correctFile(i, job, corrector, lines, [&](double share) { progress.update(done + share, total, input); });
        }
        catch (const cv::Exception& e)
        {
            complain(input, e.err, progress);
            failed++;
        }
        catch (const std::exception& e)
        {
            complain(input, e.what(), progress);
            failed++;
        }
        for (const std::string& line : lines)
            if (report)
                report->add(line);
        done++;
    }
    if (report)
        report->commit();
    return failed ? 1 : 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return rsackermann_samples::runProgram(run, argc, argv);
}
