// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_WARNINGS_HPP
#define RSACKERMANN_SAMPLES_WARNINGS_HPP

#include "job.hpp"
#include "progress.hpp"
#include "report.hpp"
#include <limits>
#include <set>
#include <vector>

namespace rsackermann_samples {

//! Says on standard error which given values have no effect, or are contradicted by the images.
class Warnings
{
public:
    Warnings(const Job& job, Progress& progress) : job_(job), progress_(progress) {}

    //! @param frames of the input, in their order.
    void add(const std::string& input, const std::vector<FrameReport>& frames);

    //! All frames have been added.
    void end();

private:
    void addContradiction(const std::string& input, const std::vector<FrameReport>& frames);
    void addTimes(const std::string& input, const std::vector<FrameReport>& frames);
    void addInterval(const FrameReport& frame, double interval);
    void endSequence(const std::string& source);
    void addRounding();
    void addRepeated();
    void addReadout();
    void addHeading();
    void addTilts();
    void addReference(const FrameReport& frame);
    void compareGyro(const FrameReport& frame);
    std::string doubtOfGyro() const;
    void addGyro(const FrameReport& frame);
    void addDepth(const FrameReport& frame);
    void addPixels(const FrameReport& frame);
    void addSpeed(const FrameReport& frame);
    void warn(const std::string& message);
    void warnOnce(const std::string& message);

    const Job& job_;
    Progress& progress_;
    bool hasContradiction_ = false, hasGap_ = false, hasFrame_ = false, isLogUsed_ = false;
    int untimed_ = 0;                                            // images of a sequence
    double squaresOfPoints_ = 0, squaresOfGyro_ = 0;             // of the rates of frames, rad/s
    double gyroTime_ = std::numeric_limits<double>::quiet_NaN(); // of the frame before
    double lastTime_ = std::numeric_limits<double>::quiet_NaN(); // of the sequence
    cv::rsackermann::AckermannMotion lastMotion_;                // of which the read-out is known
    double seenHeading_ = 0, seenHeadingSigma_ = 0;              // of the last frame that shows one
    double givenHeading_ = 0, givenHeadingSigma_ = 0;            // the same frame's
    cv::Vec2d tilts_, lastTilts_, givenTilts_;                   // sum of what frames add to roll and pitch; degrees
    int tilted_ = 0;                                             // frames of the sum
    cv::rsackermann::RollingShutterCamera tiltedCamera_;         // of the last one of them
    std::vector<double> times_, changes_;                        // of images of a sequence
    std::vector<double> intervals_;                              // of one sequence
    cv::rsackermann::RollingShutterCamera camera_;               // of the sequence
    std::set<std::string> given_;                                // warnings that hold for all inputs
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_WARNINGS_HPP
