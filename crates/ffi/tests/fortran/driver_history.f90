! Drives UMAT and VUMAT of laws with history along one-element paths and prints the bits of what they return.
program driver
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  character(len=*), parameter :: viscous = 'REESE_GOVINDJEE-NEO_HOOKEAN-SIMO_TAYLOR-HENCKY-LAME'
  character(len=*), parameter :: plastic = 'KINEMATIC-HENCKY-LAME-NEO_HOOKEAN-SIMO_TAYLOR'
  real(real64), parameter :: of_viscous(6) = [1.0_real64, 5.0_real64, 2.0_real64, 8.0_real64, 0.75_real64, 0.0_real64]
  real(real64), parameter :: of_plastic(10) = [2.0_real64, 3.0_real64, 0.25_real64, 0.5_real64, 0.25_real64, 0.125_real64, &
    0.5_real64, 4.0_real64, 1.5_real64, 0.0_real64]
  call paths(viscous, of_viscous, 9, 3)
  call paths(plastic, of_plastic, 19, 1)
  call block_of_points(viscous, of_viscous, 9)
  call beyond()
contains
  ! The paths of one element, each from the body as it was made.
  subroutine paths(name, props, nstatv, nshr)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: props(:)
    integer, intent(in) :: nstatv, nshr
    real(real64) :: state(nstatv), f0(3, 3), f1(3, 3)
    integer :: step
    state = 0; f0 = unit(); f1 = unit()
    do step = 1, 5
      f1(1, 1) = 1.0_real64 + 0.05_real64*step
      call point('uniaxial', name, props, nshr, state, f0, f1, 0.1_real64)
    end do
    state = 0; f0 = unit(); f1 = unit()
    do step = 1, 10
      f1(1, 2) = 0.1_real64*(5 - abs(5 - step))
      call point('shear', name, props, nshr, state, f0, f1, 0.1_real64)
    end do
    state = 0; f0 = unit(); f1 = unit()
    f1(1, 2) = 0.3_real64
    call point('relaxation', name, props, nshr, state, f0, f1, 1.0e-3_real64)
    do step = 1, 5
      call point('relaxation', name, props, nshr, state, f0, f1, 0.25_real64)
    end do
  end subroutine

  pure function unit() result(f)
    real(real64) :: f(3, 3)
    f = 0
    f(1, 1) = 1; f(2, 2) = 1; f(3, 3) = 1
  end function

  subroutine point(path, name, props, nshr, state, f0, f1, dtime)
    character(len=*), intent(in) :: path, name
    real(real64), intent(in) :: props(:), f1(3, 3), dtime
    integer, intent(in) :: nshr
    real(real64), intent(inout) :: state(:), f0(3, 3)
    real(real64) :: stress(3 + nshr), tangent(3 + nshr, 3 + nshr)
    call umat_at(name, props, nshr, state, f0, f1, dtime, stress, tangent)
    write (*, '(a,1x,a,1x,i0,1x,z16.16,*(1x,z16.16))') path, name, nshr, transfer(dtime, 0_int64), &
      transfer(f1, [0_int64]), transfer(state, [0_int64]), transfer(stress, [0_int64]), transfer(tangent, [0_int64])
    f0 = f1
  end subroutine

  ! UMAT with all its arguments; the time step that it asks for is printed where it is smaller.
  subroutine umat_at(name, props, nshr, state, f0, f1, dtime, stress, tangent)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: props(:), f0(3, 3), f1(3, 3), dtime
    integer, intent(in) :: nshr
    real(real64), intent(inout) :: state(:)
    real(real64), intent(out) :: stress(3 + nshr), tangent(3 + nshr, 3 + nshr)
    character(len=80) :: cmname
    real(real64) :: flow(3 + nshr), strain(3 + nshr), time(2), field(1), place(3), turn(3, 3)
    real(real64) :: sse, spd, scd, rpl, drpldt, temperature, pnewdt, length
    integer :: steps(4)
    cmname = name
    flow = 0; strain = 0; time = 0; field = 0; place = 0; turn = 0
    sse = 0; spd = 0; scd = 0; rpl = 0; drpldt = 0; temperature = 0; pnewdt = 1; length = 1
    steps = 1
    stress = 0
    tangent = 0
    call umat(stress, state, tangent, sse, spd, scd, rpl, flow, flow, drpldt, strain, strain, time, dtime, temperature, &
      temperature, field, field, cmname, 3, nshr, 3 + nshr, size(state), props, size(props), place, turn, pnewdt, length, &
      f0, f1, 1, 1, 1, 1, steps, 1)
    if (pnewdt < 1) write (*, '(a,f5.2)') 'smaller', pnewdt
  end subroutine

  ! VUMAT at time 0, and then at seven points in two increments.
  subroutine block_of_points(name, props, nstatev)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: props(:)
    integer, intent(in) :: nstatev
    integer, parameter :: n = 7
    real(real64) :: old(n, 6), new(n, 6), increment(n, 6), stress(n, 6), before(n, 6), gradient(n, 9), one(n), energy(n)
    real(real64) :: spent(n)
    real(real64) :: place(n, 3), spin(n, 3), states(n, nstatev), after(n, nstatev)
    character(len=80) :: cmname
    integer :: i, step
    cmname = name
    old = 0; old(:, 1:3) = 1
    increment = 1.0e-3_real64; before = 0; gradient = 0; one = 1; energy = 0; spent = 0; place = 0
    spin = 0; stress = 0; states = 0
    call vumat(n, 3, 3, nstatev, 1, size(props), 0, 0.0_real64, 0.0_real64, 1.0_real64, cmname, place, one, props, one, &
      increment, spin, one, old, gradient, one, before, states, energy, spent, one, old, gradient, one, stress, after, &
      energy, spent)
    write (*, '(a,*(1x,z16.16))') 'start', transfer(stress, [0_int64]), transfer(after, [0_int64])
    energy = 0
    do step = 1, 2
      do i = 1, n
        new(i, 1:3) = [1.0_real64 + 0.05_real64*i*step, 1.0_real64, 1.0_real64 - 0.02_real64*i*step]
        new(i, 4:) = 0.01_real64*i*step
      end do
      call vumat(n, 3, 3, nstatev, 1, size(props), 0, 1.0_real64, 1.0_real64, 0.25_real64, cmname, place, one, props, one, &
        increment, spin, one, old, gradient, one, before, states, energy, spent, one, new, gradient, one, stress, after, &
        energy, spent)
      write (*, '(a,*(1x,z16.16))') 'vumat', transfer(new, [0_int64]), transfer(stress, [0_int64]), &
        transfer(after, [0_int64]), transfer(energy, [0_int64])
      states = after; old = new; before = stress
    end do
  end subroutine

  ! A deformation that is none, and a wrong number of state variables.
  subroutine beyond()
    real(real64) :: f(3, 3), stress(6), tangent(6, 6), state(9), short(8)
    state = 0; short = 0; f = 0
    call umat_at(viscous, of_viscous, 3, state, unit(), f, 1.0_real64, stress, tangent)
    if (any(state /= 0)) write (*, '(a)') 'the state has changed'
    call umat_at(viscous, of_viscous, 3, short, unit(), unit(), 1.0_real64, stress, tangent)
  end subroutine
end program

! What Abaqus provides: the end of the analysis.
subroutine xit
  write (*, '(a)') 'exit'
end subroutine

subroutine xplb_exit
  write (*, '(a)') 'exit of the explicit program'
end subroutine
