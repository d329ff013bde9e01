! SPDX-License-Identifier: BSD-3-Clause
! Bodies: rectangles of linear elastic quadrilaterals in plane strain. dof = 2 (node - 1) + component.
module bodies
  use, intrinsic :: iso_c_binding, only: real64 => c_double
  implicit none
  private
  public :: rectangle, mesh_rectangle, add_stiffness

  type :: rectangle
    real(real64) :: low(2), high(2)
    integer :: cells(2)
    real(real64) :: young, poisson
    integer :: first = 0 ! number of its first node; nodes go row by row, from below
  contains
    procedure :: row => nodes_of_row
  end type rectangle

contains

  ! Nodes of row j = 0 (below) .. cells(2) (above), from left to right.
  function nodes_of_row(self, j) result(nodes)
    class(rectangle), intent(in) :: self
    integer, intent(in) :: j
    integer :: nodes(self%cells(1) + 1), i
    nodes = [(self%first + j*(self%cells(1) + 1) + i, i=0, self%cells(1))]
  end function nodes_of_row

  ! Positions of the body's nodes, x(2, all): numbers go on after `count`.
  subroutine mesh_rectangle(body, x, count)
    type(rectangle), intent(inout) :: body
    real(real64), intent(inout) :: x(:, :)
    integer, intent(inout) :: count
    integer :: i, j
    body%first = count + 1
    do j = 0, body%cells(2)
      do i = 0, body%cells(1)
        count = count + 1
        x(:, count) = body%low + (body%high - body%low)*[i, j]/body%cells
      end do
    end do
  end subroutine mesh_rectangle

  ! Four-node elements with 2 x 2 points are added to k.
  subroutine add_stiffness(body, x, k)
    type(rectangle), intent(in) :: body
    real(real64), intent(in) :: x(:, :)
    real(real64), intent(inout) :: k(:, :)
    real(real64), parameter :: corner(2, 4) = reshape([-1d0, -1d0, 1d0, -1d0, 1d0, 1d0, -1d0, 1d0], [2, 4])
    real(real64) :: d(3, 3), b(3, 8), of_xi(4, 2), jacobian(2, 2), inverse(2, 2), gradient(4, 2), det, at(2)
    integer :: below(body%cells(1) + 1), above(body%cells(1) + 1), nodes(4), dofs(8), i, j, a, p
    associate (nu => body%poisson)
      d = body%young/((1 + nu)*(1 - 2*nu))* &
        reshape([1 - nu, nu, 0d0, nu, 1 - nu, 0d0, 0d0, 0d0, 0.5d0 - nu], [3, 3])
    end associate
    do j = 1, body%cells(2)
      below = body%row(j - 1)
      above = body%row(j)
      do i = 1, body%cells(1)
        nodes = [below(i), below(i + 1), above(i + 1), above(i)]
        dofs = [(2*nodes(a) - 1, 2*nodes(a), a=1, 4)]
        do p = 1, 4
          at = corner(:, p)/sqrt(3d0)
          of_xi(:, 1) = corner(1, :)*(1 + corner(2, :)*at(2))/4
          of_xi(:, 2) = corner(2, :)*(1 + corner(1, :)*at(1))/4
          jacobian = matmul(x(:, nodes), of_xi) ! dx_i / dxi_j
          det = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
          inverse = reshape([jacobian(2, 2), -jacobian(2, 1), -jacobian(1, 2), jacobian(1, 1)], [2, 2])/det
          gradient = matmul(of_xi, inverse)
          b = 0
          b(1, 1::2) = gradient(:, 1)
          b(2, 2::2) = gradient(:, 2)
          b(3, 1::2) = gradient(:, 2)
          b(3, 2::2) = gradient(:, 1)
          k(dofs, dofs) = k(dofs, dofs) + det*matmul(transpose(b), matmul(d, b))
        end do
      end do
    end do
  end subroutine add_stiffness

end module bodies
