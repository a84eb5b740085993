// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_EQUATIONS_HPP
#define OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_EQUATIONS_HPP

#include "../optim/schur_complement.hpp"
#include "calibration_frame.hpp"

namespace cv { namespace rsackermann {

//! The unknowns of a calibration, and steps of them.
struct MountState
{
    MountVector mount;
    std::vector<FrameVector> frames;
};

//! A residual in sigmas that is linear in a few unknowns: linked values of frames, and the mount.
struct LinearTerm
{
    size_t frame; // to whose evidence it counts
    double value;
    int count, unknown[4]; // those below 0 are ~MountValue
    double slope[4];

    LinearTerm(size_t frame_, double v) : frame(frame_), value(v), count(0), unknown(), slope() {}
    void by(int which, double s)
    {
        unknown[count] = which;
        slope[count++] = s;
    }
};

//! The number of an unknown that others have to do with. @param linked from 0 to LINKED_VALUES - 1.
inline int unknownOf(size_t frame, int linked)
{
    return int(frame) * LINKED_VALUES + linked;
}

//! Normal equations of a calibration: those of its frames, what connects them, and what is known of the mount.
struct MountEquations
{
    double cost;
    std::vector<FrameEquations> frames;
    std::vector<LinearTerm> terms;
    MountMatrix prior;
    MountVector priorGradient;

    double solve(double damping, MountState& step) const;
};

//! The equations with all unknowns of the frames eliminated: first those of their scenes, then the linked ones.
class ReducedMount
{
public:
    //! @param damping part of the diagonal by which it is enlarged.
    explicit ReducedMount(const MountEquations& equations, double damping = 0);

    //! @return the gain of the step if the cost is quadratic and the damping small.
    double solve(MountState& step) const;

    //! The contribution of each frame to the gradient of the mount, if the values of the frames follow.
    std::vector<MountVector> scores() const;

    //! How the linked values follow the mount: minus the derivatives.
    const Eigen::Matrix<double, Eigen::Dynamic, MOUNT_VALUES>& linkedByMount() const { return linked.byOthers; }

    MountMatrix information;

private:
    enum { OTHERS = LINKED_VALUES + SHARED_VALUES };
    typedef Eigen::Matrix<double, Eigen::Dynamic, MOUNT_VALUES> ByMount;
    typedef Eigen::Matrix<double, OTHERS, 1> Others;
    typedef SchurComplement<Eigen::Matrix<double, SCENE_VALUES, OTHERS>, Eigen::Matrix<double, SCENE_VALUES, 1>> Scene;

    const std::vector<LinearTerm>& terms;
    std::vector<Scene> scenes;
    std::vector<Others> gradients; // of each frame, without its scene
    SchurComplement<ByMount, Eigen::VectorXd> linked;
    MountVector gradient;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CALIBRATION_MOUNT_EQUATIONS_HPP
