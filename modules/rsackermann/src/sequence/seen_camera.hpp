// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_SEEN_CAMERA_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_SEEN_CAMERA_HPP

#include "../optim/normal_equations.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

struct PreparedModel;
struct UprightSegment;

//! What slants of verticals say of the camera's values, whatever the state is: the sum of the slants' weights, and
//! normal equations about the values with which the frame was fitted.
struct CameraEvidence
{
    double weight = 0;
    CameraMatrix information;
    CameraVector gradient;

    void add(const CameraEvidence& other)
    {
        weight += other.weight;
        information += other.information;
        gradient += other.gradient;
    }
};

//! Of the unknowns of a frame, and of the camera's values.
typedef NormalEquations<FLOW_VALUES + CAMERA_VALUES> CameraEquations;

//! As SequenceState::byCamera.
typedef Eigen::Matrix<double, SEQUENCE_VALUES, CAMERA_VALUES, Eigen::RowMajor> StateByCamera;

//! Radians, of finite differences by the heading.
const double HEADING_STEP = 1. / (1 << 26);

/** That of a frame, beside the uncertainty of its state (doc/theory.md, "Sequence").
@param weights from 0 to 1, of the verticals.
@param others than slants: prior and points, at the state.
@param about the ratio by which outliers are recognised.
@param curvature of the way, 1/m, by which a camera ahead of the axle moves aside.
@param state at which slants are evaluated; its derivatives are those of the prediction, and then those of the state. */
CameraEvidence measureCamera(const RollingShutterCamera& camera, const std::vector<UprightSegment>& verticals,
                             const std::vector<double>& weights, const CameraEquations& others, double about,
                             double curvature, SequenceState& state);

//! What a sequence shows of the camera's values, each with the others as they suit it.
class SeenCamera
{
public:
    /** @param frame evidence about a camera whose values differ from the given ones.
    @param difference by so much.
    @param longestNow ratio of read-outs that is possible: a sensor reads one frame after the other. */
    void add(CameraEvidence frame, const CameraVector& difference, double longestNow);

    //! The read-out over that of the camera, of those that are possible: 1 where nothing is known; -1 if rows are read
    //! in the other direction, 0 of a global shutter.
    double readoutRatio() const;

    //! Its standard deviation, by how parts of the sequence scatter; 0: not known, or not possible, as where lane
    //! markings are all that looks like a vertical.
    double readoutRatioSigma() const;

    //! The ratio where the images contradict the given read-out, otherwise 1.
    double readoutContradiction() const;

    //! Radians beyond the given one; 0 where nothing is known.
    double heading() const;

    //! Its standard deviation; 0: not known.
    double headingSigma() const;

    //! Heading and lever by what is given and what is seen. @param headingSigma of the given one, radians.
    CameraVector difference(double headingSigma) const;

    //! Covariance of these.
    CameraMatrix covariance(double headingSigma) const;

private:
    enum { MOST_PARTS = 16 };

    CameraMatrix inverse(double ofHeading = 0) const;
    CameraVector shown(const CameraMatrix& inverse) const { return -(inverse * sum.gradient); }
    double shownRatio() const { return 1 + shown(inverse())[CAMERA_READOUT]; }
    CameraMatrix scatter(const CameraMatrix& inverse) const; // 0: not known
    double uncheckedRatioSigma() const;
    bool isPossible() const;

    double longest = 0; // sum over frames: times jitter
    int frames = 0;

    CameraEvidence sum, parts[MOST_PARTS]; // equally long, the last one of framesOfLast
    int count = 0, framesOfPart = 2, framesOfLast = 0;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SEEN_CAMERA_HPP
