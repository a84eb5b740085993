// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "rendered_drive.hpp"

namespace street {

static const double WEAVING_FREQUENCY = CV_PI / 2; // radians per second

RenderedDrive::RenderedDrive(const StreetCamera& camera, const StreetScene& street)
    : course(BEND_AND_STOP), phase(0), speedSwing(0), mounted(camera), eye(camera), start(street), scene(street),
      frames(0), seconds_(0), yaw(0)
{
    sway[0] = sway[1] = [](double) { return 0.; };
    scene.speed = scene.yawRate = scene.travelled = scene.sideways = 0;
}

void RenderedDrive::advance()
{
    scene.frame = unsigned(frames);
    seconds_ = frames++ / framesPerSecond();
    drive();
    eye.seconds = seconds_;
    eye.roll = mounted.roll + sway[0](seconds_);
    eye.pitch = mounted.pitch + sway[1](seconds_);
    scene.wallDirection = mounted.heading - yaw;
    // The road stays where it is, whether or not walls stand beside it.
    const double edges[2] = {start.left > 0 ? start.left : StreetScene().left,
                             start.right > 0 ? start.right : StreetScene().right};
    scene.edges[0] = edges[0] + scene.sideways;
    scene.edges[1] = edges[1] - scene.sideways;
    scene.left = hasWall(0) ? scene.edges[0] : 0;
    scene.right = hasWall(1) ? scene.edges[1] : 0;
}

StreetRenderer RenderedDrive::next()
{
    advance();
    return StreetRenderer(eye, scene);
}

bool RenderedDrive::hasWall(int side) const
{
    if ((side == 0 ? start.left : start.right) == 0)
        return false;
    if (course == BEND_AND_STOP)
        return side != 0 || !(seconds_ > 1 && seconds_ < 2);
    const double period = 5, begin = 1 + side, gap = 1.5, passed = std::fmod(seconds_, period);
    return course == WEAVING || !(passed > begin && passed < begin + gap);
}

cv::Vec3d RenderedDrive::ratesAt(double seconds) const
{
    StreetCamera camera = mounted;
    camera.seconds = seconds;
    return turnRates(camera, yawRateAt(seconds));
}

double RenderedDrive::speedAt(double seconds) const
{
    if (course != BEND_AND_STOP)
        return start.speed + speedSwing * std::cos(seconds * WEAVING_FREQUENCY);
    const double share = seconds < 6     ? 1
                         : seconds < 7.2 ? (7.2 - seconds) / 1.2
                         : seconds < 8.2 ? 0
                                         : (seconds - 8.2) / 3;
    return start.speed * share;
}

double RenderedDrive::yawRateAt(double seconds) const
{
    if (course != BEND_AND_STOP)
        return start.yawRate * std::sin(seconds * WEAVING_FREQUENCY + phase);
    return seconds > 2.5 && seconds < 6.5 ? start.yawRate * std::sin((seconds - 2.5) * WEAVING_FREQUENCY) : 0;
}

void RenderedDrive::drive()
{
    const int steps = 20;
    const double duration = 1 / framesPerSecond() / steps;
    if (frames == 1)
    {
        // The angle is an oscillation without an offset from the first frame on.
        if (course != BEND_AND_STOP)
            yaw = -start.yawRate / WEAVING_FREQUENCY * std::cos(phase);
    }
    else
        for (int i = 0; i < steps; i++)
        {
            const double at = seconds_ - (steps - 0.5 - i) * duration;
            scene.travelled += speedAt(at) * std::cos(yaw) * duration;
            scene.sideways += speedAt(at) * std::sin(yaw) * duration;
            yaw += yawRateAt(at) * duration;
        }
    scene.speed = speedAt(seconds_);
    scene.yawRate = yawRateAt(seconds_);
}

} // namespace street
