// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "options.hpp"

#include <cmath>
#include <map>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

// Of the camera's axes (x to the right, y down, z ahead) Gyroflow wants those that point up, to the left and backwards,
// small letters for opposites.
const char* const HEADER = "GYROFLOW IMU LOG\nversion,1.3\nid,rsackermann\norientation,yxz\n"
                           "note,rates of frames\ntscale,1\ngscale,1\nascale,1\nt,gx,gy,gz\n";

// The rate at which the camera turns at the reference line, from its poses just before and after.
cv::Vec3d ratesOf(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    const double step = 1e-4; // of row time
    cv::Matx33d before, after;
    cv::Vec3d place;
    motion.pose(camera, -step, before, place);
    motion.pose(camera, step, after, place);
    const cv::Matx33d turn = before.t() * after, twice = turn - turn.t();
    return cv::Vec3d(twice(2, 1), twice(0, 2), twice(1, 0)) * (1 / (4 * step * camera.secondsPerUnitTime()));
}

// The frames by their times.
std::map<double, MotionFrame> inOrder(const std::vector<MotionFrame>& frames)
{
    std::map<std::string, MotionFrame> last;
    for (const MotionFrame& frame : frames)
    {
        if (!std::isfinite(frame.time))
            throw InputError("--gcsv: the time of " + frame.path() + " isn't known");
        if ((frame.frame >= 0 || frames[0].frame >= 0) && frame.input != frames[0].input)
            throw InputError("--gcsv: " + frames[0].input + " and " + frame.input + " have clocks of their own");
        last[frame.path()] = frame;
    }
    std::map<double, MotionFrame> ordered;
    for (const auto& named : last)
    {
        const auto inserted = ordered.insert(std::make_pair(named.second.time, named.second));
        if (!inserted.second)
            throw InputError("--gcsv: " + inserted.first->second.path() + " and " + named.first +
                             cv::format(" have the same time, %.9g s", named.second.time));
    }
    if (ordered.size() < 2)
        throw InputError("--gcsv: there are fewer than two frames");
    return ordered;
}

} // namespace

std::string gyroLogText(const RollingShutterCamera& camera, const std::vector<MotionFrame>& frames)
{
    if (!(camera.lineDelay > 0))
        throw UsageError("--gcsv needs the line delay: --line_delay, --readout or the camera file");
    std::string text = HEADER;
    for (const auto& timed : inOrder(frames))
    {
        const MotionFrame& frame = timed.second;
        cv::Vec3d rates;
        if (frame.motion.status == MOTION_OK)
            rates = ratesOf(frame.cameraOf(camera), frame.motion);
        text += cv::format("%.9f,%.9g,%.9g,%.9g\n", frame.time, rates[0], rates[1], rates[2]);
    }
    return text;
}

} // namespace rsackermann_samples
