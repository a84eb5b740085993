// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_CALIBRATION_FRAME_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_CALIBRATION_FRAME_HPP

#include "../factors/prepared_model.hpp"
#include "../sequence/residual_noise.hpp"
#include "../optim/normal_equations.hpp"
#include "row_turns.hpp"

namespace cv { namespace rsackermann {

//! The unknowns that all frames of a drive share: corrections of the camera.
enum MountValue {
    MOUNT_ROLL,    //!< radians
    MOUNT_PITCH,   //!< radians
    MOUNT_HEADING, //!< radians
    MOUNT_LEVER,   //!< metres from the axle that moves straight ahead to the camera
    MOUNT_DELAY,   //!< logarithm of the line delay over the camera's one, as the turning of the car shows it
    MOUNT_PASSING, //!< the same as the passing of the scene shows it, which depends on how plane the scene is
    MOUNT_VALUES
};

typedef Eigen::Matrix<double, MOUNT_VALUES, 1> MountVector;
typedef Eigen::Matrix<double, MOUNT_VALUES, MOUNT_VALUES> MountMatrix;
// The first of FlowResidual's values. Those that other frames have to do with are the last ones: roll, pitch and the
// turns about both axes since the frame before.
enum { FRAME_VALUES = FLOW_PITCH_AFTER, SCENE_VALUES = SEQUENCE_ROLL, LINKED_VALUES = FRAME_VALUES - SCENE_VALUES };
enum { LINKED_ROLL, LINKED_PITCH, LINKED_PITCH_TURN, LINKED_ROLL_TURN };
typedef Eigen::Matrix<double, FRAME_VALUES, 1> FrameVector;

//! All of FlowResidual's values.
inline Vec<double, FLOW_VALUES> flowValues(const FrameVector& value)
{
    Vec<double, FLOW_VALUES> all;
    std::copy(value.data(), value.data() + FRAME_VALUES, all.val);
    return all;
}

//! Standard deviations of residuals, over the usual ones.
struct ResidualSigmas
{
    double points, slants, depths;
};

//! How a frame is seen, and its evidence.
struct CalibrationFrame
{
    int drive;                     //!< its number: frames of one drive follow each other
    double time, before, interval; //!< seconds; of the frame before; between both
    std::vector<TrackedBearing> bearings;
    std::vector<UprightSegment> verticals;
    RowTurns rowTurns;
    FrameVector value; //!< unknowns of the frame, with the whole corrections of roll and pitch
    double expected[SCENE_VALUES], sigma[SCENE_VALUES]; //!< of the first of them, as known before
    // By what residuals are multiplied: see FrameProblem::weigh().
    std::vector<Matx22d> pointWeights; // symmetric
    std::vector<double> slantWeights;

    //! By a camera of another focal length. @param upright of the camera. @param longer over the focal length before.
    void seeThroughOtherFocal(const Matx33d& upright, double longer);

    //! Of the way, 1/m.
    double curvature() const { return curvatureOf(value[SEQUENCE_YAW_RATE], value[SEQUENCE_SPEED]); }

    //! Whether there is no other frame between.
    bool follows(const CalibrationFrame& other) const { return drive == other.drive && before == other.time; }
};

//! Values of the mount on which the residuals of a frame depend: the last ones. Roll and pitch are in the frame's own
//! tilt.
enum { SHARED_VALUES = MOUNT_VALUES - MOUNT_HEADING };

//! Normal equations of a frame: for its own values, the linked ones last, and for the shared ones of the mount.
typedef NormalEquations<FRAME_VALUES + SHARED_VALUES> FrameEquations;

/** The evidence of a frame on its own values and on the camera (doc/theory.md, "Self-calibration"). */
class FrameProblem
{
public:
    FrameProblem(const RollingShutterCamera& camera, const MountVector& mount, double pointScale,
                 const ResidualSigmas& sigmas);

    /** Sets the weights of a frame's residuals by what it is thought to be. A point that isn't on its plane is seen
    elsewhere along one line, and a vertical leans otherwise: by as much they are uncertain. Points at the foot of a
    wall don't count: what is tracked there moves sideways as the wall and downwards as the road. */
    void weigh(CalibrationFrame& frame) const;

    //! With the frame's weights, at whatever value.
    FrameEquations evaluate(const CalibrationFrame& frame, const FrameVector& value) const;

    //! Adds residuals of points, in pixels.
    void addPointResiduals(const CalibrationFrame& frame, PointResiduals& residuals) const;
    //! Adds residuals of verticals, in usual sigmas.
    void addSlantResiduals(const CalibrationFrame& frame, std::vector<UncertainResidual>& slants) const;

private:
    void addPoints(const CalibrationFrame& frame, const FrameVector& value, FrameEquations& equations) const;
    void addVerticals(const CalibrationFrame& frame, const FrameVector& value, FrameEquations& equations) const;
    TrackedBearing seen(const TrackedBearing& point, const CalibrationFrame& frame) const;
    PreparedModel modelOf(const CalibrationFrame& frame, Matx<double, PARAMETERS, SEQUENCE_VALUES>* jacobian = 0) const;
    bool isAtFoot(const FlowResidual::View& view, const double* values) const;
    double slantByDepth(const UprightSegment& vertical, const CalibrationFrame& frame, const PreparedModel& model,
                        const Matx<double, PARAMETERS, SEQUENCE_VALUES>& byValues) const;

    // The direction in which the camera of a frame moves.
    double headingOf(const CalibrationFrame& frame) const { return heading + lever * frame.curvature(); }
    FlowResidual residualOf(const CalibrationFrame& frame) const { return FlowResidual(headingOf(frame), unit, focal); }

    double heading, lever, unit, givenUnit, focal, reach; // unit: as the passing of the scene shows it
    double turningUnit, turning;                          // the unit as the turning shows it, and over that
    double pointLoss;
    ResidualSigmas sigmas;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_CALIBRATION_FRAME_HPP
