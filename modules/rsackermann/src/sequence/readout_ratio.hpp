// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_READOUT_RATIO_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_READOUT_RATIO_HPP

#include "../optim/normal_equations.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

struct PreparedModel;
struct UprightSegment;

//! What slants of verticals say of the camera's values, whatever the state is: the sum of the slants' weights, and
//! normal equations about the given values.
struct ReadoutEvidence
{
    double weight = 0;
    Matx22d information;
    Vec2d gradient;

    void add(const ReadoutEvidence& other)
    {
        weight += other.weight;
        information += other.information;
        gradient += other.gradient;
    }
};

//! Of the unknowns of a frame, and of the camera's values.
typedef NormalEquations<FLOW_VALUES + CAMERA_VALUES> ReadoutEquations;

/** That of a frame, beside the uncertainty of its state (doc/theory.md, "Sequence").
@param weights from 0 to 1, of the verticals.
@param others than slants: prior and points, at the state.
@param about the ratio by which outliers are recognised.
@param state at which slants are evaluated; its derivatives are those of the prediction, and then those of the state. */
ReadoutEvidence measureReadout(const RollingShutterCamera& camera, const std::vector<UprightSegment>& verticals,
                               const std::vector<double>& weights, const ReadoutEquations& others, double about,
                               SequenceState& state);

//! The read-out that a sequence shows, over that of the camera.
class ReadoutRatio
{
public:
    //! @param longestNow ratio that is possible: a sensor reads one frame after the other.
    void add(const ReadoutEvidence& frame, double longestNow);

    //! 1 where nothing is known; -1 if rows are read in the other direction, 0 of a global shutter.
    double value() const;

    //! Its standard deviation, by how parts of the sequence scatter; 0: not known, or not possible, as where lane
    //! markings are all that looks like a vertical.
    double sigma() const;

    //! The same where the images contradict the given read-out, otherwise 1.
    double contradiction() const;

private:
    enum { MOST_PARTS = 16 };

    //! With the heading as it suits the ratio.
    struct Solution
    {
        Vec2d change;                     // of the camera's values
        double headingShare, information; // of the ratio
    };
    Solution solution() const;
    double shown() const { return 1 + solution().change[0]; }
    double scatter() const; // 0: not known
    bool isPossible() const;

    double longest = 0; // sum over frames: times jitter
    int frames = 0;

    ReadoutEvidence sum, parts[MOST_PARTS]; // equally long, the last one of framesOfLast
    int count = 0, framesOfPart = 2, framesOfLast = 0;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_READOUT_RATIO_HPP
