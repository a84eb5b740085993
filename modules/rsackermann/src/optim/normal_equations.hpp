// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP
#define OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP

#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

//! The most unknowns that can be solved for at once.
enum { MAX_UNKNOWNS = 24 };

//! As scaledInverse(), in place. Compiled once for all sizes, which templates of Eigen would be for each.
void invertScaled(Eigen::Ref<Eigen::MatrixXd> information);

//! As NormalEquations::solve(). @param step the negative gradient, and then the step.
void solveDamped(const Eigen::Ref<const Eigen::MatrixXd>& information, double damping,
                 Eigen::Ref<Eigen::VectorXd> step);

/** Inverse of a positive semidefinite matrix whose rows and columns may have units that differ by orders of magnitude:
it keeps its digits because a matrix with a diagonal of ones is inverted. What nothing is known of gets a large
variance. */
template <class Square>
Square scaledInverse(Square information)
{
    static_assert(int(Square::MaxRowsAtCompileTime) <= int(MAX_UNKNOWNS), "too many unknowns");
    invertScaled(information);
    return information;
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
        // Eigen's own update of a triangle is made for large matrices, and takes several times as long.
        information.noalias() += J.lazyProduct((weight * J).transpose().eval());
        gradient += weight * (J * r);
    }

    //! Adds what is known of an unknown beforehand, by how much it is above that and a standard deviation.
    void addPrior(int which, double above, double sigma)
    {
        cost += above / sigma * (above / sigma);
        gradient[which] += above / sigma / sigma;
        information(which, which) += 1 / (sigma * sigma);
    }

    Matrix symmetric() const { return information.template selfadjointView<Eigen::Lower>(); }

    /** Solves for the step, with the diagonal enlarged by a part of itself. An unknown on which no residual depends
    stays as it is.
    @return the gain of the step if the cost is quadratic and the damping small. */
    double solve(double damping, Vector& step) const
    {
        static_assert(MAX <= int(MAX_UNKNOWNS), "too many unknowns");
        step = -gradient;
        solveDamped(information, damping, step);
        return -step.dot(gradient);
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_OPTIM_NORMAL_EQUATIONS_HPP
