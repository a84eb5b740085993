// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "targets.hpp"
#include "files.hpp"
#include "output/result_names.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "video_timing.hpp"
#endif

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"

namespace rsackermann_samples {

static const char* const MAPS_EXTENSION = ".yml.gz";

Targets::Targets(const Job& job, const std::string& input)
    : output(resultPath(job.output, job.outputIsFolder, fileName(input))),
      overlay(resultPath(job.overlay, job.overlayIsFolder, overlayName(input))), maps(job.maps), input_(input)
{
    if (job.mapsIsFolder)
        maps = resultPath(job.maps, true, stem(input)) + (isVideo(input) ? "" : MAPS_EXTENSION);
}

std::string Targets::mapsOfFrame(int frame) const
{
    return maps + cv::format("_%06d", frame) + MAPS_EXTENSION;
}

void Targets::leaveOutExisting()
{
    for (std::string* path : {&output, &overlay})
        if (cv::utils::fs::exists(*path))
            path->clear();
    if (!maps.empty() && (isVideo(input_) ? hasMapsOfAllFrames() : cv::utils::fs::exists(maps)))
        maps.clear();
}

bool Targets::hasMapsOfAllFrames() const
{
    int count = 0;
    while (cv::utils::fs::exists(mapsOfFrame(count)))
        count++;
#ifdef RSACKERMANN_WITH_VIDEOIO
    return count > 0 && count >= countFrames(input_);
#else
    return false;
#endif
}

void Targets::check(const Job& job) const
{
    for (const std::string& path : {output, overlay})
        if (!path.empty() && !isVideo(input_) && !cv::haveImageWriter(path))
            throw InputError(path + " has the extension of no image format that can be written");
    for (const std::string& path : {output, overlay, isVideo(input_) ? std::string() : maps})
        checkResult(path, job.overwrite);
}

void Targets::addTo(OutputPlan& plan) const
{
    for (const std::string& path : {output, overlay})
        if (!path.empty())
            plan.addOutput(path, input_);
    if (!maps.empty() && isVideo(input_))
        plan.addFrames(maps, MAPS_EXTENSION, input_);
    else if (!maps.empty())
        plan.addOutput(maps, input_);
}

} // namespace rsackermann_samples
