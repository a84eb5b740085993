// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP

#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

/** Inverse of a positive semidefinite matrix whose rows and columns may have units that differ by orders of magnitude:
it keeps its digits because a matrix with a diagonal of ones is inverted. What nothing is known of gets a large
variance. */
template <class Square>
Square scaledInverse(const Square& information)
{
    const Eigen::Matrix<double, Square::RowsAtCompileTime, 1, 0, Square::MaxRowsAtCompileTime, 1> scale =
        (information.diagonal().array() + 1e-9).sqrt().inverse();
    Square scaled = scale.asDiagonal() * information * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    Square inverse = Square::Identity(scaled.rows(), scaled.cols());
    Eigen::LLT<Eigen::Ref<Square>>(scaled).solveInPlace(inverse);
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

/** Cost and normal equations of a least squares problem at a state: the sums of w r^2, w J^T r and w J^T J.
@tparam SIZE number of unknowns, or Eigen::Dynamic for at most MAX, which need no allocation. */
template <int SIZE, int MAX = SIZE>
struct NormalEquations
{
    typedef Eigen::Matrix<double, SIZE, 1, Eigen::DontAlign, MAX, 1> Vector;
    typedef Eigen::Matrix<double, SIZE, SIZE, Eigen::DontAlign, MAX, MAX> Matrix;

    double cost;
    Vector gradient;
    Matrix information; // the lower triangle counts

    explicit NormalEquations(int size = SIZE == Eigen::Dynamic ? 0 : SIZE)
        : cost(0), gradient(Vector::Zero(size)), information(Matrix::Zero(size, size))
    {
    }

    /** Adds the residuals r, in sigmas, which one robust loss weighs together.
    @param J one row for each unknown, one column for each residual.
    @param loss its cost and its slope are functions of the squared residual. */
    template <class Jacobian, class Residuals, class Loss>
    void add(const Jacobian& J, const Residuals& r, const Loss& loss)
    {
        const double squared = r.squaredNorm(), weight = loss.slope(squared);
        cost += loss.cost(squared);
        if (gradient.size() == 0)
            return; // Eigen would take the address of a first element
        information.template selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
        gradient += weight * (J * r);
    }

    Matrix symmetric() const { return information.template selfadjointView<Eigen::Lower>(); }

    /** Solves for the step, with the diagonal enlarged by a part of itself. An unknown on which no residual depends
    stays as it is.
    @return the gain of the step if the cost is quadratic and the damping small. */
    double solve(double damping, Vector& step) const
    {
        Matrix damped = information;
        damped.diagonal() *= 1 + damping;
        step = damped.template selfadjointView<Eigen::Lower>().ldlt().solve(-gradient);
        return -step.dot(gradient);
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP
