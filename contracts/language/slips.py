"""Words of the shipped crews whose slips were looked up, and slips among them that may be another word.

Made by tests/unit/contracts/language/make_slips.py; not to be edited.
"""

from crew.contracts.language.words import word_set

LOOKED_UP: frozenset[str] = word_set(
    """
    abort aborted aborting aborts across advance advanced advances advancing aerial airborne aircraft aircrafts aloft
    along amble ambled ambles ambling android androids area ascend ascended ascending ascends asks askses attend
    attended attending attends aunt auntie aunties aunts back base bear bearing bears block bloke blokes bore borne
    bots bottle boys bring bringing brings brother brothers brought buggies buggy came camper campers cancel canceled
    canceling cancels canned canning cans canvass canvassed canvasses canvassing carried carries carry carrying cars
    cart carted carting carts casualties casualty cease ceased ceases ceasing chap chaps charger charging check
    checked checking checks child children childs chopper choppers clasp clasped clasping clasps climb climbed climber
    climbers climbing climbs clutch clutched clutches clutching colleague colleagues comb combed combing combs come
    comes coming convey conveyance conveyed conveying conveys coordinates coordinatesed coordinateses coordinatesing
    copter copters could coulded coulding coulds courier couriered couriering couriers cousin cousins cover covered
    covering covers cube daddies daddy dads daughter daughters deliver delivered delivering delivers delivery deploy
    deployed deploying deploys deposit deposited depositing deposits descend descended descending descends desist
    desisted desisting desists despatch despatched despatches despatching detect detected detecting detects direct
    directed directing directs discover discovered discovering discovers dispatch dispatched dispatches dispatching
    dock doggie doggies doggo doggoes doggy dogs down drive driven drives driving droid droids drone drones drop
    dropoff dropped dropping drops drove east eastern easthalf ended ending ends enter entered entering enters
    everything everywhere examine examined examines examining explore explored explores exploring father fathers
    fellow fellows ferried ferries ferry ferrying fetch fetched fetches fetching field find finding finds first flew
    flies flown flyer flyers flying found freeze freezes freezing friend friends froze frozen gave gentleman
    gentlemans gets getting girl girls give given gives giving goes going gone goodbye gotten grab grabbed grabbing
    grabs grandad grandads granddad granddads granddaughter granddaughters grandfather grandfathers grandma grandmas
    grandmother grandmothers grandpa grandpas grandson grandsons grannies granny grasp grasped grasping grasps greet
    greeted greeting greets grip gripped gripping grips ground guys half halt halted halting halts hand handed handing
    hands hang hanged hanging hangs haul hauled hauling hauls have haved haves having head headed heading heads held
    helicopter helicopters hello here heres hiker hikers hold holding holds home hound hounds hover hovered hovering
    hovers humanoid humanoids hunt hunted hunting hunts husband husbands injured inspect inspected inspecting inspects
    iris jogger joggers journey journeyed journeying journeys keep keeped keeping keeps kids ladies lady land landed
    landing lands launch launched launches launching layed laying lays lift lifted lifting lifts like liked likes
    liking load loaded loading loads locate located locates locating location look looked looking looks lugged lugging
    lugs machine machines make maked makes making mans mayed maying mays might mighted mighting mights missing mission
    mommies mommy moms mother mothers move moved moves moving multicopter multicopters mummies mummy mums myself
    myselfs navigate navigated navigates navigating need needed needing needs neighbour neighbours nephew nephews
    niece nieces north northern northhalf operation operational operationalarea operator operators other over part
    pass passed passes passing patient patients payload payloadtray people person persons pick picked picking picks
    pickup pinpoint pinpointed pinpointing pinpoints place placed places placing plonk plonked plonking plonks plop
    plopped plopping plops point pooch pooches popped popping pops portion position positioned positioning positions
    probe probed probes probing proceed proceeded proceeding proceeds puppies puppy pups puts putting quad quadcopter
    quadcopters quadrocopter quadrocopters quadrotor quadrotors quadruped quadrupedal quadrupeds quads recall recalled
    recalling recalls recce recced recces reccing recon reconnaissance reconnoiter reconnoitered reconnoitering
    reconnoiters reconnoitre reconnoitred reconnoitres reconnoitring redcube redeploy redeployed redeploying redeploys
    redirect redirected redirecting redirects region relocate relocated relocates relocating relocation report
    reported reporting reports reposition repositioned repositioning repositions requester requesters reroute rerouted
    reroutes rerouting respond responded responding responds rest rested resting rests return returned returning
    returns right robodog robodogs robot robots room rooma roomb round route routed routes routing rover rovers runned
    runner runners running runs sayed saying says scan scanned scanning scans scour scoured scouring scours search
    searched searches searching second section sector seek seeking seeks seize seized seizes seizing send sending
    sends sent sets setted setting shift shifted shifting shifts shuttle shuttled shuttles shuttling side sister
    sisters site sons sought south southern southhalf spot stand standed standing stands start starting station steer
    steered steering steers stick sticked sticking sticks still stop stopped stopping stops stroll strolled strolling
    strolls survey surveyed surveying surveys survivor survivors sweep sweeping sweeps swept table tablea tableb take
    taken takeoff takeoffed takeoffing takeoffs takes taking tell telling tells their them there they through told
    took tote toted totes toting touch touched touches touching track tracked tracking tracks transfer transfered
    transfering transfers transport transportation transported transporting transports travel traveled traveling
    travels trawl trawled trawling trawls tray trot trots trotted trotting trouble trundle trundled trundles trundling
    turtlebot turtlebots uavs ugvs uncle uncles unit units uses vehicle vehicles victim victims walk walked walker
    walkers walking walks want wanted wanting wants water wave waved waves waving went west western westhalf wheeled
    where whoever whole wife wifes with woman womans women work worked working works your zone
    """
)

DOUBTFUL: frozenset[str] = word_set(
    """
    abck able ables abling abor abors abort abortin abot abots abrt abse acme acrs adance adds advance aeral agve
    aircraft alng alof alon alot alying ambe ambel amble amle amles android anties ants aong aort aprt apss arial
    ascen ascend ascendd askes askss asses assk atken atten attend attendd attende attned auns aunt auntie auts baer
    baers baes baring bars beaing bear bearrs beas beraing bering bers bggies bggy bing binging bings blck blke bllock
    bloc blok bloke bloks bock boer boke bone bonre bore boren born bost bosy bother bothers bought brig briging brigs
    briing brin bring brins brne broe brone brothe brother brothes brough brring bttle bugg bugges caarts cacel camer
    camers campe camper cance cancel cancelled cancelling cances caned canel caning caninng canne cannig canvas
    canvased canvases canvasess canvasing canvasse canvasss caper capers caps cared caries caring carr carred carres
    carrie carring carrts cars cart carte cary casalty case cased cases casing casp casualy cated cating catr catred
    catring catrs cats causalty ceaes cease ceasse chager chaging chap charer charge chargin charing chas chck chcked
    chcking chcks check checke checkeed chek cheks chid chil child chilld chils choppe chopper chpper chps clap claped
    claping claps clapss clas clased clasing clasp class classp cliber clibers clim climb climbe climber climed
    climing clims clmber clutche cnned cnning cobs coer coered coering coers coes coing cold colds colleague colud
    coluded coluding coluds comb combe combiing combin combinng come comed coming commes coms coney coneys conve
    conveed conveing convey conveye convy convys coordinate coordinateed coordinatees coordinatess coper copers copper
    coppers copter cosin coter coud couded couding couds coul could couldd couled couling couls courier cousin
    couurier cove coveed coveing cover coves covey coveys cras crat crated crating crats crried crries crry crrying
    crted crts cultch curier cutch cutches cvers dadd dadies dady daughter deect deected deecting deects deist deists
    deliveer deliver delivere deliverr delver delvers deploy deply deposiing deposit depositin depost descen descend
    descendd desised desising desisst desist desits despatche detect detectin detet deteted detets dgos direct
    directin diret direts discoveer discover discovere discoverr dispatche dive dives diving dogg dogge dogges doggie
    doggoe dogie dogies dogy done dopped dopping dops dorp dove drid drids drie drien dries drive droe droes droi
    droid drois dron drone drons droopping droops drop droping droppe dros drpped drpping drps drve drves dspatch
    dspatched dspatches dspatching easter eats ecase ecased ecasing eded eding edns endd ened enter entere entr entre
    entres erst esat ests eter eters examine examinee examinees examne exploe exploed exploer exploers exploes
    exploing explore explorre explorres expored exporing fater faters father feeze feld fellow feries ferr ferres
    ferrie ferris fery fetche fids fied fiedl fiel fieldd fiend fiends fies fild filed files find fining fins firs
    firsst firt firts fist fler flers fles flie fling flis fllies fllow fllows flon flow flyer fnding fnds fond foud
    foun foundd fown freee freees freeing freeze freze fried friend frined frist froe froen froze frried frries frry
    frrying frst ftch fund fyer fyers fying gabbed gabbing gabs garb garbs gasp gasped gasping gasps geet geets
    gentleman gentlemn geos geret gerets gest gien gies gils ging gips girl girlls girs give gnoe goen goin gong
    goodby gooing gose grab grabbe granad granda grandad grandadd grandads grandam grandams grandas grandd grandda
    granddad granddadd granddads granddaughter grandds grandfather grandma grandmother grandpa grandpaa grandppa
    grandson grann grannie grany grap graped graping graps gras grased grasing grasp grass grassp grbbing grbs gree
    greeed greeing grees greet greete gret grete grets gril grils grip griped griping grippe gris grond groundd grund
    gtes gtting gusy guvs haded hading hadn hads haed haeds haes hagn hags haing haled haling hals halt halte hand
    handd hande haned hang hange haning hans hated hating hats haul hauld haule haus have head headd heade heaed
    heaing heas heded heding heds heer heers hees helicopter hell here heress hers herse hier hiers hike hiker hikes
    hled hllo hlts hnds hnged hnted hnting hnts hods hoer hoers hold holing hols hond hoover hoovered hoovering
    hoovers hound houndd hove hover hoves hres hual huled huling huls humanoid huns hunt hunte husband huting huts
    hvering hves hwoever ilke injure insect insected insects inspect inspectin inured jgger jogge jogger journey keeed
    keeing keep keepe kees laddies laded lades ladie lading ladn lads laed laing lanch land landd lande laned laning
    lans launces launche layd laye layeed lfit lfits lfts lgged lgging lied lies lift lifte liing like likeed likin
    liks lited liting lits lkes lnding lnds load loadd loade loaed loaing loas loate loated loates loating locae
    locaes locate locatin loded loding lods loked loking loks looed looing look looke loos luged lugge luging lunch
    lunched lunches lunching lyas lying mable mabled mables mabling machin machine maed maes maing make maks masn maye
    might mising missin mkes mmmies mmmy mmos mmus mnas moed moes moing momm moter mother move mssing mther mumm mysel
    myself navigate navigatin neded neding neds need needd neede neeed neighbor neighbors neighbour nephew neter
    netered netering nice nicee nices niec niece northen norther noth nucle nucles obts obys oges oging omms operatin
    operationall operator opps oter otte ottes ozne pace paced paces pacing palce palces pased pases pasing passe
    passin passs passse patent patents patient payloa pcked pcking pcks peerson peron person peson piced picing pick
    picke pickeed pics piked piking piks pinpoint pint piont plaace plaaces placd place plae plaed plaes plaing plnk
    plnking plnks plok plon plonk plons plop plos poch poches poin poit polp polps pont pooc pooh poopped poopping
    poped poping poppe popped poppin popping pops portin portio porton positin position positon potion ppos pppies
    pppy ppus prat prceeded prceeding preson prob probe proceed proceedd proceeed proe proed proes proing prson prsons
    psas psot pssed psses pssing ptting pupp puppes puppis puting puttin quad quadrupe quadruped quas quds rboot
    rboots rdone reall realls recal recall recc recce reccess reced reces reconnoite reconnoiter reconnoiters
    reconnoitr reconnoitre redcue redeploy redirect redirectin reested reests regin rellocation relocate relocatin
    reocation reon reort reorted reorting reorts repor report reporte reposition repot requeste requester rerote
    reroute resed resing resond resonded resonding resonds respond respondd responde respons ress resst ressted
    ressting ressts rest reste restted restting reted reting rets retun retuning return reurn reurns robot robt roer
    roers roma romo rond rooam roob room root roots rote roted roting roud roue roued roues rouet rouing roun roundd
    rout route routin routs rove rover roves rroute rrouted rroutes rrouting rset rsets rsted rsting rsts runed runer
    runing runne runner runnes ruted ruting rver rvers saed saing saks sand sanded sanding sands sanned sanning sans
    sarch sarched sart sarting sasy sation scan scanne scas scor scored scoring scors scou scoued scouing scour scoure
    scous sction scur scured scuring sdie searche secondd seding sedn sedns seds seection seector seeing seek seep
    seeping seeps seer seered seering seers sees seie seies seize seizin seke sekes send sening sens sensd sept seted
    seter seters seting setn sette shft shfted shfting shfts shift shifte shit shited shiting shits shutte shuttes
    shutting shuttle sick sicked sicking sicks sied sift sifted sifting sifts siister sill siser sister siter siters
    size sized sizes sizing snding snds sned snet snos sopped sopping sops soth sough souht sour soured souring sours
    sout souther southren sroll srolling srolls stad stan stand standd staned staning stans star staring stat statin
    stating staton stck stcked stcking stcks stee steeed steeer steer stees ster stere steres stering stes stic stick
    sticke stie stik stiking stiks stil stll stoopped stoopping stoops stop stoped stoping stoppe stpped stpping stps
    strat stroll strolld strolle strt stted stting sues surey survey survivor survy suttle suttled suttling swee sweep
    swees swep swet syed sying taable tabl tabla table tack tacked tacking tacks taek taen taes taing take takeoff
    takin takn taks tale tary tavel teir tell tels tere thee theer ther theree thir thme thorugh though thre three
    throough thye tken tkes tking tlling tlls toch toched toches toching toed toes toher toing toko tooted tooting
    tort torts tote tots totted totting touche touh trac traced tracing track tracke tracs tral traled traling trals
    transfer transfere transferr transferred transferring transport transporte trave travel travele travelled
    travelling traves trawl trawle trck trcked trcking trcks tros trot trotte trough trts trundle tted tting ttoe
    ttoed ttoes tuch unce uncle unis unit unles unti unts upps urns usse vehicle veicle veicles victim vitim voer waed
    waer waes waing waivng waked waker wakers waking wakling waks waled waler walers waling walk walke walker walkes
    wals waned waning wans want wate wated wating watr wats wave waveed waviing were wester wets whee wheelde wheele
    wheer wher whle whoe whooever whre wies wife wiht wnted woan woen woks wole woman womn wooman wored woring work
    worke wors wves
    """
)
