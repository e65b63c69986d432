! Drives UMAT and VUMAT along one-element paths and prints the bits of what they return.
program driver
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  real(real64) :: f(3, 3)
  integer :: step
  do step = 0, 10
    f = 0
    f(1, 1) = 1.0_real64 + 0.1_real64*step
    f(2, 2) = 1
    f(3, 3) = 1
    call point('uniaxial', f)
    f(1, 1) = 1
    f(1, 2) = 0.1_real64*step
    call point('shear', f)
  end do
  ! Held: three more increments at the last deformation.
  do step = 1, 3
    call point('held', f)
  end do
  call block_of_points(3)
  call block_of_points(1)
  call beyond()
contains
  ! UMAT of three materials at one deformation.
  subroutine point(path, f)
    character(len=*), intent(in) :: path
    real(real64), intent(in) :: f(3, 3)
    call standard(path, 'MOONEY_RIVLIN', [0.5_real64, 0.25_real64, 1.0_real64], f, 3)
    call standard(path, 'COMPRESSIBLE-GENT-SIMO_TAYLOR', [1.0_real64, 50.0_real64, 100.0_real64], f, 1)
    call standard(path, 'TREAD', [real(real64) ::], f, 3)
  end subroutine

  subroutine standard(path, name, props, f, nshr)
    character(len=*), intent(in) :: path, name
    real(real64), intent(in) :: props(:), f(3, 3)
    integer, intent(in) :: nshr
    real(real64) :: stress(3 + nshr), tangent(3 + nshr, 3 + nshr)
    call umat_at(name, props, f, nshr, stress, tangent)
    write (*, '(a,1x,a,1x,i0,*(1x,z16.16))') path, name, nshr, transfer(f, [0_int64]), transfer(stress, [0_int64]), &
      transfer(tangent, [0_int64])
  end subroutine

  ! UMAT with all its arguments and one state variable, which an elastic law leaves alone.
  subroutine umat_at(name, props, f, nshr, stress, tangent)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: props(:), f(3, 3)
    integer, intent(in) :: nshr
    real(real64), intent(out) :: stress(3 + nshr), tangent(3 + nshr, 3 + nshr)
    character(len=80) :: cmname
    real(real64) :: state(1), flow(3 + nshr), strain(3 + nshr), time(2), field(1), place(3), turn(3, 3)
    real(real64) :: sse, spd, scd, rpl, drpldt, dtime, temperature, pnewdt, length
    integer :: steps(4)
    cmname = name
    state = 7; flow = 0; strain = 0; time = 0; field = 0; place = 0; turn = 0
    sse = 0; spd = 0; scd = 0; rpl = 0; drpldt = 0; dtime = 1; temperature = 0; pnewdt = 1; length = 1
    steps = 1
    stress = 0
    tangent = 0
    call umat(stress, state, tangent, sse, spd, scd, rpl, flow, flow, drpldt, strain, strain, time, dtime, temperature, &
      temperature, field, field, cmname, 3, nshr, 3 + nshr, 1, props, size(props), place, turn, pnewdt, length, f, f, &
      1, 1, 1, 1, steps, 1)
    if (state(1) /= 7) write (*, '(a)') 'the state has changed'
    if (pnewdt < 1) write (*, '(a,f5.2)') 'smaller', pnewdt
  end subroutine

  ! VUMAT at seven points that are stretched and sheared, then at time 0.
  subroutine block_of_points(nshr)
    integer, intent(in) :: nshr
    integer, parameter :: n = 7
    real(real64) :: stretch(n, 3 + nshr), increment(n, 3 + nshr), stress(n, 3 + nshr), old(n, 3 + nshr)
    real(real64) :: gradient(n, 3 + 2*nshr), one(n), energy(n), place(n, 3), spin(n, nshr), props(3)
    real(real64) :: state(n), spent(n)
    character(len=80) :: cmname
    integer :: i
    props = [0.5_real64, 0.25_real64, 1.0_real64]
    cmname = 'MOONEY_RIVLIN'
    stretch = 0; old = 0; gradient = 0; one = 1; energy = 0; spent = 0; place = 0; spin = 0; stress = 0
    do i = 1, n
      stretch(i, 1:3) = [1.0_real64 + 0.1_real64*i, 1.0_real64, 1.0_real64 - 0.05_real64*i]
      stretch(i, 4:) = 0.02_real64*i
    end do
    increment = 1.0e-3_real64*stretch
    call vumat(n, 3, nshr, 1, 1, 3, 0, 1.0_real64, 1.0_real64, 1.0_real64, cmname, place, one, props, one, increment, spin, &
      one, stretch, gradient, one, old, one, energy, spent, one, stretch, gradient, one, stress, state, energy, spent)
    if (any(state /= 1)) write (*, '(a)') 'the states were not kept'
    write (*, '(a,1x,i0,*(1x,z16.16))') 'vumat', nshr, transfer(stretch, [0_int64]), transfer(stress, [0_int64])
    call vumat(n, 3, nshr, 1, 1, 3, 0, 0.0_real64, 0.0_real64, 1.0_real64, cmname, place, one, props, one, increment, spin, &
      one, stretch, gradient, one, old, one, energy, spent, one, stretch, gradient, one, stress, state, energy, spent)
    write (*, '(a,1x,i0,*(1x,z16.16))') 'start', nshr, transfer(increment, [0_int64]), transfer(stress, [0_int64])
  end subroutine

  ! A deformation that turns the body inside out, and a material that is none.
  subroutine beyond()
    real(real64) :: f(3, 3), stress(6), tangent(6, 6)
    f = 0
    call umat_at('MOONEY_RIVLIN', [0.5_real64, 0.25_real64, 1.0_real64], f, 3, stress, tangent)
    f(1, 1) = 1; f(2, 2) = 1; f(3, 3) = 1
    call umat_at('MOONEY_RIVLIN', [0.5_real64], f, 3, stress, tangent)
  end subroutine
end program

! What Abaqus provides: the end of the analysis.
subroutine xit
  write (*, '(a)') 'exit'
end subroutine

subroutine xplb_exit
  write (*, '(a)') 'exit of the explicit program'
end subroutine
