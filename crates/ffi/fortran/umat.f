C     Hyperelastic laws of Piola as a user material of Abaqus/Standard.
C
C     *MATERIAL, NAME=COMPRESSIBLE-GENT-SIMO_TAYLOR
C     *USER MATERIAL, CONSTANTS=3
C     1.0E6, 50.0, 1.0E9
C
C     The name is that of a law, with its parameters as constants, or
C     that of a file in the folder PIOLA_MATERIALS, without constants.
C     STRESS is the Cauchy stress and DDSDDE the tangent of Jaumann's
C     rate of the Kirchhoff stress over J: 11, 22, 33, 12, 13, 23.
C     Solid elements, plane strain and axisymmetric elements (NDI = 3).
C
C     A deformation without an answer asks for a smaller increment. What
C     else is wrong is printed, and the analysis ends.
C
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      USE, INTRINSIC :: ISO_C_BINDING
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),
     1 DDSDDE(NTENS,NTENS),DDSDDT(NTENS),DRPLDE(NTENS),
     2 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PREDEF(1),DPRED(1),
     3 PROPS(NPROPS),COORDS(3),DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),
     4 JSTEP(4)
      INTERFACE
        INTEGER(C_INT) FUNCTION PIOLA_UMAT(NAME,NAMELEN,PROPS,NPROPS,
     1   NDI,NSHR,F,STRESS,TANGENT) BIND(C,NAME='piola_umat')
          USE, INTRINSIC :: ISO_C_BINDING
          IMPLICIT NONE
          CHARACTER(KIND=C_CHAR), INTENT(IN) :: NAME(*)
          INTEGER(C_SIZE_T), VALUE :: NAMELEN, NPROPS, NDI, NSHR
          REAL(C_DOUBLE), INTENT(IN) :: PROPS(*), F(*)
          REAL(C_DOUBLE), INTENT(INOUT) :: STRESS(*), TANGENT(*)
        END FUNCTION
        INTEGER(C_SIZE_T) FUNCTION PIOLA_MESSAGE(TEXT,LENGTH)
     1   BIND(C,NAME='piola_last_error_padded')
          USE, INTRINSIC :: ISO_C_BINDING
          IMPLICIT NONE
          CHARACTER(KIND=C_CHAR), INTENT(OUT) :: TEXT(*)
          INTEGER(C_SIZE_T), VALUE :: LENGTH
        END FUNCTION
      END INTERFACE
      INTEGER(C_INT) ISTATUS
      INTEGER(C_SIZE_T) LENGTH
      CHARACTER(LEN=480) MESSAGE
      ISTATUS = PIOLA_UMAT(CMNAME, INT(LEN(CMNAME),C_SIZE_T),
     1 PROPS, INT(NPROPS,C_SIZE_T), INT(NDI,C_SIZE_T),
     2 INT(NSHR,C_SIZE_T), DFGRD1, STRESS, DDSDDE)
      IF (ISTATUS .EQ. 0) RETURN
      IF (ISTATUS .EQ. 6) THEN
        PNEWDT = 0.25D0
        RETURN
      END IF
      LENGTH = PIOLA_MESSAGE(MESSAGE, INT(LEN(MESSAGE),C_SIZE_T))
      WRITE(*,*) 'UMAT, element ', NOEL, ', point ', NPT, ': ',
     1 TRIM(MESSAGE)
      CALL XIT
      END
