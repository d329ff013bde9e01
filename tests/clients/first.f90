program first
  use, intrinsic :: iso_c_binding
  use ents
  implicit none
  character(*), parameter :: text = '{"segment": "quad4",' // &
    ' "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]},' // &
    ' "contact": {"normal": {"type": "penalty", "stiffness": 1000}}}'
  real(c_double), target :: slave(3) = [-0.4d0, 0.3d0, -0.1d0]
  real(c_double), target :: master(3, 4) = reshape([-1d0, -1d0, 0d0, 1d0, -1d0, 0d0, 1d0, 1d0, 0d0, -1d0, 1d0, 0d0], [3, 4])
  real(c_double), target :: gap, residual(15), tangent(15, 15)
  type(ents_report) :: report
  type(ents_input) :: in
  type(ents_output) :: out
  type(c_ptr) :: model
  integer(c_int32_t) :: status
  integer :: i

  in = ents_input(slave=c_loc(slave), master=c_loc(master))
  out = ents_output(wanted=ENTS_GAP + ENTS_RESIDUAL + ENTS_TANGENT, &
    gap=c_loc(gap), residual=c_loc(residual), tangent=c_loc(tangent))

  status = ents_model_create(text, len(text, c_int64_t), c_null_ptr, c_null_ptr, 0_c_int64_t, model, report)
  if (status == ENTS_OK) status = ents_evaluate(model, 0_c_int64_t, 1_c_int64_t, in, out, report)
  if (status /= ENTS_OK) then
    print '(a)', ents_string(report%message)
    stop 1
  end if
  print '(3es24.16e2)', (gap, residual(i), tangent(i, 3), i = 1, 15)
  status = ents_model_destroy(model, report)
end program first
