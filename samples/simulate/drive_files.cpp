// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "drive_files.hpp"
#include "camera_file.hpp"
#include "depth_image.hpp"
#include "files.hpp"
#include "output/image_file.hpp"
#include "progress.hpp"
#include "truth_file.hpp"
#include "units.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include <algorithm>

namespace rsackermann_samples {

static const double CLEARANCE = 0.5; // metres from the camera to a wall
static const double MARGIN = 0.2;    // seconds that the gyro measures before and after the frames

static void checkClearance(street::RenderedDrive drive, int frames)
{
    for (int i = 0; i < frames; i++)
    {
        const bool hasLeft = drive.street().left > 0, hasRight = drive.street().right > 0;
        drive.advance();
        if ((hasLeft && drive.street().left < CLEARANCE) || (hasRight && drive.street().right < CLEARANCE))
            throw UsageError(cv::format("the car reaches a wall after %.2f s: a smaller --yaw_rate or --speed or more "
                                        "room (--left, --right) is needed",
                                        drive.seconds()));
    }
}

std::string DriveFiles::frameName(int number) const
{
    return cv::format("%06d.png", number);
}

std::vector<std::string> DriveFiles::folders() const
{
    std::vector<std::string> all = {folder + "frames/"};
    if (depth)
        all.push_back(folder + "depth/");
    if (global)
        all.push_back(folder + "global/");
    return all;
}

std::vector<std::string> DriveFiles::names() const
{
    std::vector<std::string> all;
    for (const char* name : {"truth.jsonl", "log.csv", "gyro.csv", "camera.yml"})
        all.push_back(folder + name);
    for (const std::string& of : folders())
        for (int i = 0; i < frames; i++)
            all.push_back(of + frameName(i));
    return all;
}

std::string DriveFiles::gyroText(const street::RenderedDrive& drive) const
{
    const double readOut = drive.camera().lineDelay * std::max(drive.camera().size.width, drive.camera().size.height),
                 last = (frames - 1) / street::RenderedDrive::framesPerSecond();
    cv::Mat times, rates;
    gyro.measure([&drive](double seconds) { return drive.ratesAt(seconds); }, -readOut - MARGIN,
                 last + readOut + MARGIN, times, rates);
    std::string text = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n";
    for (int i = 0; i < times.rows; i++)
        // Looking down is a turn against the x axis.
        text += cv::format("%.6f,%.5f,%.5f,%.5f\n", times.at<double>(i), rates.at<double>(i, 1) / DEGREE,
                           -rates.at<double>(i, 0) / DEGREE, rates.at<double>(i, 2) / DEGREE);
    return text;
}

void DriveFiles::write(const street::RenderedDrive& from) const
{
    checkClearance(from, frames);
    for (const std::string& of : folders())
        if (cv::utils::fs::exists(of + frameName(frames)))
            throw InputError(of + frameName(frames) + " is of a longer drive; remove that first");
    street::RenderedDrive drive = from;
    std::string truths, log = "file,time_s\n";
    Progress progress;
    for (int i = 0; i < frames; i++)
    {
        const std::string name = frameName(i), path = folder + "frames/" + name;
        const street::StreetRenderer view = drive.next();
        writeImage(path, view.rollingShutter(samples, rays));
        if (depth)
            writeImage(folder + "depth/" + name, depthImage(view.rollingDepth()));
        if (global)
            writeImage(folder + "global/" + name, view.globalShutter(samples, rays));
        truths += truthLine(name, {drive.camera(), drive.street()});
        log += name + cv::format(",%.9f\n", drive.seconds());
        progress.update(i + 1, frames, path);
    }
    writeFile(folder + "log.csv", log);
    writeFile(folder + "gyro.csv", gyroText(drive));
    writeFile(folder + "truth.jsonl", truths);
    writeCameraFile(folder + "camera.yml", camera);
}

} // namespace rsackermann_samples
