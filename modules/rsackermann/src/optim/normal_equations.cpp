// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "normal_equations.hpp"

namespace cv { namespace rsackermann {

// Without allocation.
typedef Eigen::Matrix<double, Eigen::Dynamic, 1, 0, MAX_UNKNOWNS, 1> SmallVector;
typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, MAX_UNKNOWNS, MAX_UNKNOWNS> SmallMatrix;

void invertScaled(Eigen::Ref<Eigen::MatrixXd> information)
{
    const SmallVector scale = (information.diagonal().array() + 1e-9).sqrt().inverse();
    SmallMatrix scaled = scale.asDiagonal() * information * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(scaled);
    SmallVector column(scale.size());
    for (int i = 0; i < scale.size(); i++)
    {
        column.setZero();
        column[i] = scale[i];
        factors.solveInPlace(column);
        information.col(i) = scale.cwiseProduct(column);
    }
}

void solveDamped(const Eigen::Ref<const Eigen::MatrixXd>& information, double damping, Eigen::Ref<Eigen::VectorXd> step)
{
    SmallMatrix damped = information;
    damped.diagonal() *= 1 + damping;
    step = Eigen::LDLT<Eigen::Ref<Eigen::MatrixXd>>(damped).solve(step);
}

}} // namespace cv::rsackermann
