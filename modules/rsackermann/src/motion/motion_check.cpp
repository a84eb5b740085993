// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "motion_check.hpp"

namespace cv { namespace rsackermann {

static void checkOffset(const AckermannMotion& motion)
{
    const Mat& offset = motion.inverseDepthOffset;
    const Rect2d& area = motion.offsetArea;
    if (offset.empty())
        return;
    REJECT_IF(offset.dims != 2 || offset.type() != CV_64FC1 || !InverseDepthOffset::isPossible(offset.size()),
              "motion.inverseDepthOffset is a %d x %d matrix of type %s; %s of type CV_64FC1 are expected", offset.rows,
              offset.cols, typeToString(offset.type()).c_str(), InverseDepthOffset::possibleSizes().c_str());
    REJECT_IF(
        !cv::checkRange(offset, true, 0, -LARGEST_VALUE, LARGEST_VALUE),
        "motion.inverseDepthOffset has values that aren't finite or beyond +-%g; finite ones up to it are expected",
        LARGEST_VALUE);
    checkFinite(area.x, "motion.offsetArea.x");
    checkFinite(area.y, "motion.offsetArea.y");
    checkPositive(area.width, "motion.offsetArea.width");
    checkPositive(area.height, "motion.offsetArea.height");
}

static void checkWords(const AckermannMotion& motion)
{
    REJECT_IF(motion.status < MOTION_OK || motion.status > MOTION_NOT_OBSERVABLE,
              "motion.status is %d; one of the MotionStatus values 0 to 4 is expected", motion.status);
    const int model = motion.model;
    REJECT_IF(model != MODEL_NONE && model != MODEL_1LA && model != MODEL_3LA && model != MODEL_4LA,
              "motion.model is %d; one of the MotionModel values 0, 1, 3 and 4 is expected", model);
    REJECT_IF(motion.direction != 1 && motion.direction != -1,
              "motion.direction is %d; 1 (forward) or -1 (reverse) is expected", motion.direction);
    REJECT_IF(motion.scale < SCALE_UNKNOWN || motion.scale > SCALE_SPEED,
              "motion.scale is %d; one of the MotionScale values 0 to 3 is expected", motion.scale);
}

void checkMotion(const AckermannMotion& motion)
{
    checkWords(motion);
    checkOffset(motion);
    const double values[] = {motion.alpha,           motion.wallSlope,   motion.wallOffset, motion.wallRatio,
                             motion.roadSlope,       motion.pitchRate,   motion.rollRate,   motion.rollCorrection,
                             motion.pitchCorrection, motion.wallDistance};
    const char* const names[] = {"alpha",     "wallSlope", "wallOffset",     "wallRatio",       "roadSlope",
                                 "pitchRate", "rollRate",  "rollCorrection", "pitchCorrection", "wallDistance"};
    const double largest = 1e150; // the walls' inverse depths, products of two of them, are finite
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++)
        REJECT_IF(!(std::abs(values[i]) <= largest), "motion.%s is %g; a number from %g to %g is expected", names[i],
                  values[i], -largest, largest);
}

}} // namespace cv::rsackermann
