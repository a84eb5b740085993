// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "targets.hpp"
#include "files.hpp"

#include "opencv2/core/utils/filesystem.hpp"

namespace rsackermann_samples {

static const char* const MAPS_EXTENSION = ".yml.gz";

Targets::Targets(const Job& job, const std::string& input)
    : output(resultPath(job.output, job.outputIsFolder, input)), overlay(resultPath(job.overlay, job.overlayIsFolder, input)),
      maps(job.maps)
{
    if (job.mapsIsFolder)
        maps = resultPath(job.maps, true, stem(input)) + (isVideo(input) ? "" : MAPS_EXTENSION);
}

std::string Targets::mapsOfFrame(int frame) const
{
    return maps + cv::format("_%06d", frame) + MAPS_EXTENSION;
}

bool Targets::exist() const
{
    // The output is written last: where it exists everything does.
    return cv::utils::fs::exists(output.empty() ? overlay : output);
}

void Targets::check(const Job& job, const std::string& input) const
{
    for (const std::string& path : {output, overlay, maps})
    {
        if (path.empty())
            continue;
        if (isSameFile(path, input))
            throw InputError("the result " + path + " would replace the input");
        if (cv::utils::fs::isDirectory(path))
            throw InputError(path + " is a folder");
        if (!job.overwrite && !job.skipExisting && cv::utils::fs::exists(path))
            throw InputError(path + " exists (--overwrite replaces it)");
    }
}

} // namespace rsackermann_samples
