C     Laws of Piola as a user material of Abaqus/Explicit, in double
C     precision: elastic laws, and laws with history (library with its
C     feature `history`).
C
C     The name of the material, its constants and the number of its
C     state variables are those of UMAT. No tangent is computed.
C     The law THERMAL takes tempNew as its temperature. The first call
C     takes the reference temperature: it has no thermal stress.
C     Stresses are corotated: R^T T R = T(U), from the stretches U,
C     11, 22, 33, 12, 23, 13. The first call of a run, at time 0, asks
C     for the stiffness of the body at rest by small strains in no time.
C     The energy that a step dissipates stays in the internal energy.
C
      subroutine vumat(
     1 nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal,
     2 stepTime, totalTime, dt, cmname, coordMp, charLength,
     3 props, density, strainInc, relSpinInc,
     4 tempOld, stretchOld, defgradOld, fieldOld,
     5 stressOld, stateOld, enerInternOld, enerInelasOld,
     6 tempNew, stretchNew, defgradNew, fieldNew,
     7 stressNew, stateNew, enerInternNew, enerInelasNew )
      use, intrinsic :: iso_c_binding
      include 'vaba_param.inc'
      dimension props(nprops), density(nblock), coordMp(nblock,*),
     1 charLength(nblock), strainInc(nblock,ndir+nshr),
     2 relSpinInc(nblock,nshr), tempOld(nblock),
     3 stretchOld(nblock,ndir+nshr),
     4 defgradOld(nblock,ndir+nshr+nshr),
     5 fieldOld(nblock,nfieldv), stressOld(nblock,ndir+nshr),
     6 stateOld(nblock,nstatev), enerInternOld(nblock),
     7 enerInelasOld(nblock), tempNew(nblock),
     8 stretchNew(nblock,ndir+nshr),
     9 defgradNew(nblock,ndir+nshr+nshr),
     1 fieldNew(nblock,nfieldv), stressNew(nblock,ndir+nshr),
     2 stateNew(nblock,nstatev), enerInternNew(nblock),
     3 enerInelasNew(nblock)
      dimension rest(nblock,ndir+nshr)
      character*80 cmname
      interface
        integer(c_int) function piola_vumat(name,namelen,
     1   props,nprops,points,ndir,nshr,before,after,added,dt,
     2   heat,nheat,old,new,nstate,stresses)
     3   bind(c,name='piola_vumat')
          use, intrinsic :: iso_c_binding
          implicit none
          character(kind=c_char), intent(in) :: name(*)
          integer(c_size_t), value :: namelen, nprops, points
          integer(c_size_t), value :: ndir, nshr, nheat, nstate
          real(c_double), intent(in) :: props(*), before(*), after(*)
          real(c_double), intent(in) :: old(*), heat(*)
          real(c_double), value :: added, dt
          real(c_double), intent(inout) :: new(*), stresses(*)
        end function
        integer(c_size_t) function piola_message(text,length)
     1   bind(c,name='piola_last_error_padded')
          use, intrinsic :: iso_c_binding
          implicit none
          character(kind=c_char), intent(out) :: text(*)
          integer(c_size_t), value :: length
        end function
      end interface
      integer(c_int) istatus
      integer(c_size_t) length
      character(len=480) message
      if (totalTime .eq. 0.d0) then
        do i = 1, nblock
          do k = 1, ndir+nshr
            rest(i,k) = 0.d0
            if (k .le. ndir) rest(i,k) = 1.d0
          end do
        end do
        istatus = piola_vumat(cmname,
     1   int(len(cmname),c_size_t), props, int(nprops,c_size_t),
     2   int(nblock,c_size_t), int(ndir,c_size_t),
     3   int(nshr,c_size_t), rest, strainInc, 1.d0, 0.d0,
     4   tempNew, int(0,c_size_t),
     5   stateOld, stateNew, int(nstatev,c_size_t), stressNew)
      else
        istatus = piola_vumat(cmname,
     1   int(len(cmname),c_size_t), props, int(nprops,c_size_t),
     2   int(nblock,c_size_t), int(ndir,c_size_t),
     3   int(nshr,c_size_t), stretchOld, stretchNew, 0.d0, dt,
     4   tempNew, int(nblock,c_size_t),
     5   stateOld, stateNew, int(nstatev,c_size_t), stressNew)
      end if
      if (istatus .ne. 0) then
        length = piola_message(message, int(len(message),c_size_t))
        write(*,*) 'VUMAT: ', trim(message)
        call xplb_exit
        return
      end if
C     Work of the mean stress on the strain increment, per mass.
      do i = 1, nblock
        work = 0.d0
        do k = 1, ndir+nshr
          factor = 0.5d0
          if (k .gt. ndir) factor = 1.d0
          work = work + factor*(stressOld(i,k)+stressNew(i,k))
     1     *strainInc(i,k)
        end do
        enerInternNew(i) = enerInternOld(i) + work/density(i)
        enerInelasNew(i) = enerInelasOld(i)
      end do
      return
      end
